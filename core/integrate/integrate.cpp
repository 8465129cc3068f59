#include "core/integrate/integrate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/error.hpp"
#include "core/integrate/evaluator.hpp"
#include "core/integrate/events.hpp"
#include "core/integrate/methods.hpp"
#include "core/integrate/own_errors.hpp"
#include "core/integrate/progress.hpp"

namespace qdot {
namespace {

// The methods compare products of times with zero; squares of shorter spans underflow.
constexpr double shortest_span = 1e-140;

/// Appends so many copies of a row.
void append(std::vector<double>& rows, std::span<const double> row, std::size_t count) {
  const std::size_t begin = rows.size();
  rows.resize(begin + count * row.size());
  for (auto to = rows.begin() + static_cast<std::ptrdiff_t>(begin); to != rows.end();)
    to = std::ranges::copy(row, to).out;
}

class Integration {
 public:
  Integration(const RightHandSide& system, const RunRequest& request)
      : request_(request), stepper_(make_stepper(system, request)), events_(request), progress_(request) {
    run_.t = request.t_start;
    run_.y = request.y_start;
    const std::size_t numbers = request.grid.size() * request.y_start.size();
    run_.states.reserve(numbers);
    if (!request.is_reference) return;
    run_.unseen.reserve(numbers);
    run_.accelerations.reserve(numbers / 2);
    if (request.originals == nullptr) return;
    own_errors_.emplace(*request.originals, request.apart, request.t_start);
    run_.apart.reserve(numbers);
    run_.apart_by_rounding.reserve(numbers);
  }

  Run run() && {
    run_.ending = go();
    run_.steps = stepper_->steps();
    run_.evaluations = stepper_->evaluations();
    run_.bounded = stepper_->bounded() && events_.saw_everything();
    run_.untold = events_.untold();
    run_.signs = events_.signs_before(run_.t);
    run_.unseen_at_end.assign(stepper_->unseen().begin(), stepper_->unseen().end());
    if (own_errors_) run_.apart_at_end = own_errors_->now();
    return std::move(run_);
  }

 private:
  Ending go() {
    if (const auto wrong = unusable(run_.y, request_.limits.max_magnitude)) return *wrong;
    if (const auto failed = sample_until(run_.t)) return *failed;
    if (run_.t < request_.t_end && request_.t_end - run_.t < shortest_span) return Ending::tolerance;
    while (run_.t < request_.t_end)
      if (const auto ended = advance()) return *ended;
    return Ending::reached_end;
  }

  // One step, what happened in it, and the rows that lie in it: all of it, or nothing if something failed.
  std::optional<Ending> advance() {
    if (stepper_->steps() >= request_.limits.max_steps) return Ending::step_limit;
    if (const auto failed = stepper_->step()) return failed;
    if (const auto wrong = unusable(stepper_->y(), request_.limits.max_magnitude)) return wrong;

    const EventSearch::Found found = events_.search(*stepper_);
    if (found.failure) return found.failure;
    const double t = found.terminal ? found.events.back().t : stepper_->t();
    if (own_errors_) follow_until(t);
    if (found.terminal) stepper_->end_at(t);
    take_approaches();
    const std::size_t first = run_.rows;
    if (const auto failed = sample_until(t)) return failed;

    run_.t = t;
    if (found.terminal)
      run_.y = found.events.back().y;
    else
      std::ranges::copy(stepper_->y(), run_.y.begin());
    run_.events.insert(run_.events.end(), found.events.begin(), found.events.end());
    if (run_.events.size() > most_occurrences)
      throw Error(ErrorCode::too_large, "the motion meets more events than one answer may hold");
    if (found.terminal) return Ending::event;
    if (is_given_up(first)) return Ending::given_up;
    return run_.t < request_.t_end ? progress_.check(*stepper_) : std::nullopt;
  }

  void take_approaches() {
    for (Approach& approach : events_.take_approaches()) {
      for (std::size_t i = 0; own_errors_ && i < run_.y.size(); ++i)
        approach.apart.push_back(own_errors_->in_last_step(i));
      approach.unseen.assign(stepper_->unseen().begin(), stepper_->unseen().end());
      run_.approaches.push_back(std::move(approach));
    }
    if (run_.approaches.size() < most_approaches_) return;
    take_together(run_.approaches);
    most_approaches_ = std::max(most_approaches_, 2 * run_.approaches.size());
  }

  [[nodiscard]] bool is_given_up(std::size_t first) const {
    if (!request_.goes_on || first == run_.rows) return false;
    return !request_.goes_on(first, std::span(run_.states).subspan(first * request_.y_start.size()));
  }

  // The rows up to and including t; on failure those of before.
  std::optional<Ending> sample_until(double t) {
    std::size_t end = run_.rows;
    while (end < request_.grid.size() && request_.grid[end] <= t) ++end;
    if (end == run_.rows) return std::nullopt;
    const std::size_t n = request_.y_start.size(), count = end - run_.rows;
    run_.states.resize(end * n);
    const auto failed =
        stepper_->sample(request_.grid.subspan(run_.rows, count), std::span(run_.states).last(count * n));
    if (failed) {
      run_.states.resize(run_.rows * n);
      return failed;
    }
    note_unseen(count);
    note_accelerations(count);
    note_own_errors(count);
    run_.rows = end;
    return std::nullopt;
  }

  // What the step may hide counts for all of its rows.
  void note_unseen(std::size_t count) {
    const std::span<const double> unseen = stepper_->unseen();
    if (unseen.empty()) return;
    const std::size_t n = request_.y_start.size();
    run_.unseen.resize(run_.rows * n);
    append(run_.unseen, unseen, count);
  }

  void follow_until(double t) {
    auto step = stepper_->polynomials();
    if (!step) return;
    step->h = std::min(step->h, t - step->t);
    own_errors_->follow(*step);
  }

  void note_own_errors(std::size_t count) {
    if (!own_errors_) return;
    const std::size_t n = request_.y_start.size();
    own_.resize(n);
    for (std::size_t i = 0; i < n; ++i) own_[i] = own_errors_->in_last_step(i);
    append(run_.apart, own_, count);
    for (std::size_t i = 0; i < n; ++i) own_[i] = own_errors_->rounding_in_last_step(i);
    append(run_.apart_by_rounding, own_, count);
  }

  void note_accelerations(std::size_t count) {
    if (!request_.is_reference) return;
    const std::span<const double> of_step = stepper_->accelerations();
    std::vector<double>& all = run_.accelerations;
    if (of_step.empty())
      all.resize((run_.rows + count) * (run_.y.size() / 2), std::numeric_limits<double>::quiet_NaN());
    append(all, of_step, count);
  }

  const RunRequest& request_;
  std::unique_ptr<Stepper> stepper_;
  EventSearch events_;
  ProgressGuard progress_;
  std::optional<OwnErrors> own_errors_;
  std::vector<double> own_;            ///< of the last step
  std::size_t most_approaches_{2000};  ///< before they are taken together
  Run run_;
};

}  // namespace

Run integrate(const RightHandSide& system, const RunRequest& request) {
  assert(system.dimension > 0 && request.y_start.size() == system.dimension);
  assert(std::isfinite(request.t_start) && std::isfinite(request.t_end) && request.t_start <= request.t_end);
  assert(std::ranges::is_sorted(request.grid));
  return Integration(system, request).run();
}

}  // namespace qdot
