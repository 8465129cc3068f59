#include "core/grading/other_solutions.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/zeroness.hpp"
#include "core/grading/ball_system.hpp"
#include "core/grading/linear_in.hpp"

namespace qdot {
namespace {

constexpr std::size_t highest_degree = 8;
constexpr std::uint64_t work_on_line = 100'000;
constexpr std::uint64_t work_on_derivative = 12'000;  // of each
constexpr int states_of_lines = 12;

/// The coefficients of phi, which are seen at one state after another.
class Line {
 public:
  Line(const ExpectedSystem& system, RightMotion& right, const Expression& residual)
      : right_(right), along_(residual.graph().symbol("way along the line")) {
    Graph& graph = residual.graph();
    std::vector<Replacement> moved;
    for (const Expression& a : system.unknowns()) {
      direction_.push_back(graph.symbol("direction of " + std::get<Symbol>(a.node()).name));
      moved.emplace_back(a, a + along_ * direction_.back());
    }
    if (!has_kink_in(residual, system.unknowns()))
      coefficients_ = coefficients_of(substitute(residual, moved));
    if (is_polynomial()) values_.emplace(coefficients_);
  }

  [[nodiscard]] bool is_polynomial() const { return !coefficients_.empty(); }

  /// False where something has no value.
  bool look(State& state, std::size_t coordinate) {
    if (!right_.set(state, *values_)) return false;
    std::vector<Ball> unit(direction_.size(), Ball(0.0));
    unit[coordinate] = Ball(1.0);
    const auto d = qdot::solved(right_.matrix(), unit);
    if (!d) return false;
    for (std::size_t i = 0; i < d->size(); ++i) values_->set(direction_[i], (*d)[i]);
    values_->set(along_, Ball(0.0));
    values_->evaluate();
    seen_.clear();
    for (const Expression& c : coefficients_) seen_.push_back(values_->of(c));
    return std::ranges::all_of(seen_, [](const Ball& c) { return c.is_finite(); });
  }

  /// What the last state shows of other solutions.
  [[nodiscard]] OtherSolutions others() const {
    std::size_t low = 0, high = seen_.size() - 1;
    while (low < seen_.size() && vanishes(low)) ++low;
    if (low == seen_.size()) return OtherSolutions::everything;
    while (high > low && vanishes(high)) --high;
    if (seen_[low].contains_zero() || seen_[high].contains_zero()) return OtherSolutions::unknown;
    const std::size_t degree = high - low;
    if (degree == 0) return OtherSolutions::none;
    const bool changes_sign = (seen_[low].value() > 0) != (seen_[high].value() > 0);
    if (degree % 2 == 1 || changes_sign) return OtherSolutions::some;
    if (degree > 2) return OtherSolutions::unknown;
    const Ball discriminant = seen_[low + 1] * seen_[low + 1] - Ball(4.0) * seen_[low] * seen_[high];
    if (discriminant.contains_zero()) return OtherSolutions::unknown;
    return discriminant.value() > 0 ? OtherSolutions::some : OtherSolutions::none;
  }

 private:
  /// phi^(k)(0)/k!; none where phi is no polynomial of low degree.
  [[nodiscard]] std::vector<Expression> coefficients_of(Expression phi) const {
    const std::array start{Replacement{along_, along_.graph().number(0)}};
    std::vector<Expression> found;
    for (std::int64_t k = 1; found.size() <= highest_degree; ++k) {
      found.push_back(substitute(phi, start));
      phi = Number::ratio(1, k) * differentiate(phi, along_);
      if (phi.is_zero() || zeroness(phi, work_on_derivative) == Zeroness::zero) return found;
    }
    return {};
  }

  [[nodiscard]] bool vanishes(std::size_t k) const { return values_->vanishes(coefficients_[k]); }

  RightMotion& right_;
  Expression along_;
  std::vector<Expression> direction_;
  std::vector<Expression> coefficients_;
  std::optional<BallValues> values_;
  std::vector<Ball> seen_;
};

OtherSolutionsAnswer at_seeded_states(Line& line, RightMotion& right, std::size_t coordinate,
                                      std::uint64_t seed) {
  SampledStates states(right.symbols(), seed);
  int without = 0, free = 0;
  for (int i = 0; i < 2 * states_of_lines; ++i) {
    State state = states.next();
    if (!line.look(state, coordinate)) continue;
    const OtherSolutions here = line.others();
    if (here == OtherSolutions::some) return {here, state};
    if (here == OtherSolutions::none) ++without;
    if (here == OtherSolutions::everything) ++free;
    if (here == OtherSolutions::unknown) return {};
  }
  if (without >= states_of_lines && free == 0) return {OtherSolutions::none, {}};
  if (free >= states_of_lines && without == 0) return {OtherSolutions::everything, {}};
  return {};
}

}  // namespace

OtherSolutionsAnswer other_solutions(const ExpectedSystem& system, RightMotion& right,
                                     const Expression& residual, std::size_t coordinate, std::uint64_t seed) {
  try {
    const WorkScope scope(work_on_line);
    Line line(system, right, residual);
    if (!line.is_polynomial()) return {};
    return at_seeded_states(line, right, coordinate, seed);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return {};
  }
}

}  // namespace qdot
