#include "core/dynamics/consistent_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"
#include "core/dynamics/constraint_surface.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {
namespace {

constexpr double as_typed = 1e-12;     ///< of the terms: what decimals may leave
constexpr double found = 1e-14;        ///< of a nearest state
constexpr int most_steps = 50;         ///< of Newton's method
constexpr int most_refinements = 4;    ///< in twice the digits
constexpr double rounding = 0x1p-100;  ///< of such a refinement, relative

class Consistency {
 public:
  Consistency(const Dynamics& dynamics, const Reals& parameters, double t)
      : scene_(dynamics.model().scene),
        surface_(*dynamics.constraint_surface()),
        parameters_(parameters),
        t_(t),
        states_(surface_, parameters_) {}

  Reals of(const Reals& y, const std::vector<bool>& given) {
    if (!states_.evaluate(t_, y))
      throw Error(ErrorCode::invalid_state, "The constraints have no finite value in this state.");
    if (!holds(y, as_typed)) refuse(y, given);
    if (is_flat({y.begin(), y.end()})) undetermined();
    return refined(y, std::vector<bool>(n(), true));
  }

  Reals completed(const Reals& y, const std::vector<bool>& given) {
    std::vector<double> near = y;
    std::vector<bool> free = given;
    free.flip();
    std::vector<bool> all = free;
    all.resize(2 * n(), true);
    if (!reach(near, all)) {
      if (!states_.evaluate(t_, y))
        throw Error(ErrorCode::invalid_state, "The constraints have no finite value in this state.");
      all.flip();
      refuse(y, all);
    }
    if (is_flat(near)) undetermined();
    Reals completed = y;
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (i >= n() || free[i]) completed.set(i, near[i]);
    }
    return refined(std::move(completed), free);
  }

 private:
  [[nodiscard]] std::size_t n() const { return surface_.coordinates(); }

  /// Of the state that was evaluated last.
  [[nodiscard]] bool holds(std::span<const double> y, double share) const {
    return violated(y, share) == states_.residuals().size();
  }
  [[nodiscard]] std::size_t violated(std::span<const double> y, double share) const {
    const std::span<const double> residuals = states_.residuals();
    std::size_t k = 0;
    while (k < residuals.size() && std::abs(residuals[k]) <= share * states_.size_of_terms(k, y)) ++k;
    return k;
  }

  /// Whether a phi has no slope where it is 0, as (x - l)^2 there: nothing tells how far it is from 0 then.
  /// A step that takes away as much of it as typed decimals may leave changes such a slope by more than half.
  [[nodiscard]] bool is_flat(const std::vector<double>& y) {
    std::vector<double> wanted(surface_.positions()), step(n());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (!states_.evaluate(t_, y)) return true;
      std::ranges::fill(wanted, 0.0);
      wanted[k] = as_typed * states_.size_of_terms(k, y);
      if (!states_.step_of_positions(wanted, std::vector<bool>(n(), true), step)) return true;
      if (!keeps_slope(k, wanted[k], y, step, 1) && !keeps_slope(k, wanted[k], y, step, -1)) return true;
    }
    return false;
  }

  /// Whether phi k changes along the step as it does at its beginning; `side` is the way that is taken.
  bool keeps_slope(std::size_t k, double wanted, std::vector<double> y, std::span<const double> step,
                   double side) {
    for (std::size_t i = 0; i < n(); ++i) y[i] += side * step[i];
    return states_.evaluate(t_, y) && std::abs(states_.change(k, step) + wanted) <= wanted / 2;
  }

  [[noreturn]] void refuse(const Reals& y, const std::vector<bool>& given) {
    const std::size_t k = violated(y, as_typed), positions = surface_.positions();
    const bool is_position = k < positions;
    const bool is_rate_of_position = !is_position && is_holonomic(k - positions);
    const std::string& name =
        scene_.constraints[is_position ? surface_.position_of()[k] : k - positions].name;
    const std::string what =
        is_rate_of_position ? "moves away from the constraint '" + name + "', whose value then changes and"
                            : "does not obey the constraint '" + name + "', whose value";
    throw InconsistentState("The initial state " + what + " has to stay 0.", nearest(y, given));
  }

  [[nodiscard]] bool is_holonomic(std::size_t constraint) const {
    return std::ranges::find(surface_.position_of(), constraint) != surface_.position_of().end();
  }

  InconsistentState::Nearest nearest(const Reals& from, const std::vector<bool>& given) {
    std::vector<bool> not_given(2 * n());
    for (std::size_t i = 0; i < not_given.size(); ++i) not_given[i] = !given[i];
    for (const std::vector<bool>& free : {not_given, std::vector<bool>(2 * n(), true)}) {
      std::vector<double> y = from;
      if (reach(y, free)) return by_name(y);
    }
    return {};
  }

  [[nodiscard]] InconsistentState::Nearest by_name(const std::vector<double>& y) const {
    InconsistentState::Nearest result;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const bool is_rate = i >= n();
      result.emplace_back(scene_.coordinates[is_rate ? i - n() : i].name + (is_rate ? "_dot" : ""), y[i]);
    }
    return result;
  }

  bool reach(std::vector<double>& y, const std::vector<bool>& free) {
    const auto half = free.begin() + static_cast<std::ptrdiff_t>(n());
    const std::vector<bool> of_positions(free.begin(), half), of_rates(half, free.end());
    std::vector<double> step(n());
    const std::size_t positions = surface_.positions();
    for (int i = 0; i < most_steps; ++i) {
      if (!states_.evaluate(t_, y)) return false;
      if (holds(y, found)) return true;
      if (!states_.step_of_positions(states_.residuals().first(positions), of_positions, step)) return false;
      for (std::size_t k = 0; k < n() && positions > 0; ++k) y[k] += step[k];
      if (!states_.evaluate(t_, y)) return false;
      if (!states_.step_of_rates(states_.residuals().subspan(positions), of_rates, step)) return false;
      for (std::size_t k = 0; k < n(); ++k) y[n() + k] += step[k];
    }
    return false;
  }

  /// Newton's steps of the positions that are free and of all rates by residuals in balls, which have twice
  /// the digits.
  Reals refined(Reals y, const std::vector<bool>& free) {
    const std::vector<Ball> parameters = parameters_.as<Ball>();
    TapeEvaluator<Ball> evaluator(surface_.values(), parameters);
    evaluator.set_time(Ball::literal(t_));
    const std::vector<bool> all(n(), true);
    std::vector<double> step(n());
    const std::size_t positions = surface_.positions();
    for (int i = 0; i < most_refinements; ++i) {
      if (!states_.evaluate(t_, y)) undetermined();
      std::vector<double> residuals = in_twice_the_digits(evaluator, y);
      if (positions > 0) {
        if (!states_.step_of_positions(std::span(residuals).first(positions), free, step)) undetermined();
        move(y, 0, step);
        residuals = in_twice_the_digits(evaluator, y);
      }
      if (!states_.step_of_rates(std::span(residuals).subspan(positions), all, step)) undetermined();
      move(y, n(), step);
    }
    return y;
  }

  std::vector<double> in_twice_the_digits(TapeEvaluator<Ball>& evaluator, const Reals& y) const {
    std::vector<Ball> values(surface_.values().outputs(), Ball(0));
    evaluator(y.as<Ball>(), values);
    std::vector<double> residuals;
    for (std::size_t k = 0; k < surface_.positions() + surface_.constraints(); ++k)
      residuals.push_back(values[surface_.first_residual() + k].real().value);
    return residuals;
  }

  static void move(Reals& y, std::size_t first, std::span<const double> step) {
    for (std::size_t i = 0; i < step.size(); ++i) {
      const Real& old = y.exact(first + i);
      if (step[i] == 0) continue;
      const DoubleDouble moved = old.double_double() + DoubleDouble(step[i]);
      y.set(first + i, {moved.high, moved.low, old.error + rounding * std::abs(moved.high)});
    }
  }

  [[noreturn]] void undetermined() const { refuse_dependent_constraints(scene_); }

  const Scene& scene_;
  const ConstraintSurface& surface_;
  const Reals& parameters_;
  double t_;
  ConstrainedStates states_;
};

}  // namespace

void refuse_dependent_constraints(const Scene& scene) {
  if (scene.constraints.size() == 1)
    throw Error(ErrorCode::invalid_state,
                "In this state the constraint '" + scene.constraints[0].name +
                    "' has no slope, or determines no force, so the motion is undetermined.");
  std::string names;
  for (const Constraint& c : scene.constraints) names += (names.empty() ? "'" : ", '") + c.name + "'";
  throw Error(ErrorCode::invalid_state,
              "In this state the constraints " + names +
                  " depend on each other or determine no forces, so the motion is undetermined.");
}

Reals consistent_state(const Dynamics& dynamics, const Reals& parameters, double t, const Reals& y,
                       const std::vector<bool>& given) {
  if (!dynamics.model().has_constraints()) return y;
  return Consistency(dynamics, parameters, t).of(y, given);
}

Reals completed_state(const Dynamics& dynamics, const Reals& parameters, double t, const Reals& y,
                      const std::vector<bool>& given) {
  return Consistency(dynamics, parameters, t).completed(y, given);
}

}  // namespace qdot
