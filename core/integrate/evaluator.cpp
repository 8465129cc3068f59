#include "core/integrate/evaluator.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/work.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t poll_interval = 64;  // evaluations; then it checks whether anyone waits

bool finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

}  // namespace

Answer Evaluator::derivative(double t, std::span<const double> y, std::span<double> f) noexcept {
  return evaluate(system_.derivative, t, y, f);
}

Answer Evaluator::jacobian(double t, std::span<const double> y, std::span<double> jacobian) noexcept {
  return evaluate(system_.jacobian, t, y, jacobian);
}

Answer Evaluator::evaluate(const Function& function, double t, std::span<const double> y,
                           std::span<double> out) noexcept {
  try {
    if (!limits_allow_another()) return answer_stop;
    if (const auto wrong = unusable(y, limits_.max_magnitude)) return refuse(answer_retry, *wrong);
    if (const auto trouble = trouble_of(function(t, y, out))) return refuse(answer_retry, *trouble);
    return finite(out) ? answer_ok : refuse(answer_retry, Ending::nonfinite);
  } catch (...) {
    exception_ = std::current_exception();
    return refuse(answer_stop, Ending::nonfinite);  // rethrow() says more
  }
}

bool Evaluator::limits_allow_another() {
  if (stopped_) return false;
  if (evaluations_ >= limits_.max_evaluations) {
    refuse(answer_stop, Ending::step_limit);
    return false;
  }
  ++evaluations_;
  if (evaluations_ % poll_interval == 0) check_interruption();
  return true;
}

Answer Evaluator::refuse(Answer answer, Ending why) {
  trouble_ = why;
  stopped_ = answer == answer_stop;
  return answer;
}

std::optional<Ending> unusable(std::span<const double> y, double max_magnitude) {
  bool is_usable = true;
  for (const double component : y) is_usable = is_usable & (std::abs(component) <= max_magnitude);
  if (is_usable) return std::nullopt;
  std::optional<Ending> wrong;
  for (const double component : y) {
    if (std::isnan(component)) return Ending::nonfinite;
    if (std::abs(component) > max_magnitude) wrong = Ending::blow_up;
  }
  return wrong;
}

}  // namespace qdot
