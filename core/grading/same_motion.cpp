#include "core/grading/same_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/expr/linear.hpp"
#include "core/expr/zeroness.hpp"
#include "core/grading/ball_system.hpp"
#include "core/grading/equation_size.hpp"
#include "core/grading/factored_equations.hpp"
#include "core/grading/linear_equations.hpp"
#include "core/grading/linear_in.hpp"
#include "core/grading/other_solutions.hpp"
#include "core/grading/proven_root.hpp"
#include "core/grading/right_motion.hpp"

namespace qdot {
namespace {

/// Whether an equation says anything of the unknowns. One of positions or velocities alone that holds on the
/// surface of constraints holds all the time, and so do its derivatives, which are put in its place.
bool give_slope(const ExpectedSystem& system, Expression& residual) {
  constexpr int most_derivatives = 2;
  for (int k = 0; has_no_slope(residual, system.unknowns()); ++k) {
    if (!system.has_constraints() || k == most_derivatives) return false;
    residual = total_derivative(residual, system.symbols().rates());
  }
  return true;
}

class MotionComparison {
 public:
  MotionComparison(const ExpectedSystem& system, std::span<const Expression> residuals, std::uint64_t seed,
                   double tolerance)
      : system_(system),
        accelerations_(system.symbols().coordinates.second_rate),
        unknowns_(system.unknowns()),
        residuals_(residuals.begin(), residuals.end()),
        right_(system),
        seed_(seed),
        tolerance_(tolerance) {}

  MotionVerdict verdict(std::optional<std::size_t> coordinate) {
    MotionVerdict verdict;
    for (std::size_t k = 0; k < residuals_.size(); ++k) {
      const VanishingAnswer answer = on_the_right_motion(residuals_[k]);
      verdict.equation = k;
      verdict.decided_by = answer.decision;
      if (answer.decision == Decision::unknown) return verdict;
      if (answer.decision == Decision::counterexample) return contradicted(verdict, answer);
      is_rounded_ = is_rounded_ || answer.decision == Decision::rounded;
      values_decide_ = values_decide_ || answer.decision == Decision::values;
    }
    for (std::size_t k = 0; k < residuals_.size(); ++k) {
      verdict.equation = k;
      if (!make_linear(residuals_[k])) return not_linear(verdict, coordinate);
    }
    verdict.decided_by = is_rounded_      ? Decision::rounded
                         : values_decide_ ? Decision::values
                                          : Decision::identity;
    for (std::size_t k = 0; k < residuals_.size(); ++k) {
      if (give_slope(system_, residuals_[k])) continue;
      verdict.equation = k;
      verdict.fault = MotionFault::holds_always;
      return verdict;
    }
    verdict.fault = fault_of_linear(system_, right_, residuals_, coordinate, seed_ + 1);
    return verdict;
  }

 private:
  VanishingAnswer on_the_right_motion(const Expression& residual) {
    std::optional<EquationSize> size;
    if (tolerance_ > 0) size.emplace(system_, right_, residual);
    return vanishing({.value = residual,
                      .symbols = right_.symbols(),
                      .seed = seed_,
                      .complete = [&](State& state, BallValues& values) { return right_.set(state, values); },
                      .in_symbols = [&] { return right_.in_letters(residual); },
                      .tolerance = tolerance_,
                      .size = [&](const State& state) { return size ? (*size)(state) : 0; }});
  }

  MotionVerdict contradicted(MotionVerdict verdict, const VanishingAnswer& answer) {
    verdict.fault = MotionFault::not_true;
    verdict.counterexample = answer.counterexample;
    if (accelerations_.size() == 1) verdict.acceleration = submitted_acceleration(answer.counterexample);
    return verdict;
  }

  /// Equations that may have other solutions.
  MotionVerdict not_linear(MotionVerdict verdict, std::optional<std::size_t> coordinate) {
    verdict.fault = MotionFault::not_linear;
    if (accelerations_.size() == 1) coordinate = 0;
    if (is_rounded_) return verdict;
    OtherSolutionsAnswer others = others_of(coordinate);
    if (others.found == OtherSolutions::unknown) return verdict;
    verdict.decided_by = Decision::values;
    if (others.found == OtherSolutions::none) verdict.fault = MotionFault::none;
    if (others.found == OtherSolutions::everything)
      verdict.fault = coordinate ? MotionFault::other_coordinate : MotionFault::dependent;
    if (others.found != OtherSolutions::some) return verdict;
    verdict.fault = MotionFault::other_solutions;
    verdict.decided_by = Decision::counterexample;
    verdict.counterexample = std::move(others.state);
    return verdict;
  }

  /// By the line along which one coordinate is free, by factors, or by a root that is proven. The right
  /// equations of the other coordinates, or else those of the constraints, stand beside.
  OtherSolutionsAnswer others_of(std::optional<std::size_t> coordinate) {
    std::vector<Expression> all = residuals_;
    if (coordinate) {
      const auto found = other_solutions(system_, right_, residuals_[0], *coordinate, seed_ + 4);
      if (found.found != OtherSolutions::unknown) return found;
      for (std::size_t i = 0; i < unknowns_.size(); ++i) {
        if (i != *coordinate) all.push_back(right_equation(i));
      }
    } else {
      for (std::size_t i = accelerations_.size(); i < unknowns_.size() && all.size() < unknowns_.size(); ++i)
        all.push_back(right_equation(i));
      const bool are_few =
          std::ranges::any_of(all, [&](const Expression& e) { return has_no_slope(e, unknowns_); });
      if (all.size() != unknowns_.size() || are_few) return {};
    }
    const auto found = other_solutions_of_factors(system_, right_, all, seed_ + 5);
    if (found.found != OtherSolutions::unknown) return found;
    return proven_other_root(system_, right_, all, seed_ + 6);
  }

  [[nodiscard]] Expression right_equation(std::size_t i) const {
    Expression residual = -system_.right()[i];
    for (std::size_t j = 0; j < unknowns_.size(); ++j)
      residual = residual + system_.matrix()[i][j] * unknowns_[j];
    return residual;
  }

  /// -B/A of an equation A q'' + B = 0.
  std::optional<double> submitted_acceleration(const State& state) {
    if (!make_linear(residuals_[0])) return std::nullopt;
    const Expression slope = differentiate(residuals_[0], accelerations_[0]);
    BallValues values(std::array{residuals_[0], slope});
    for (std::size_t i = 0; i < state.size(); ++i) values.set(right_.symbols()[i].symbol, state[i]);
    values.set(accelerations_[0], Ball(0.0));
    values.evaluate();
    const Ball found = -values.of(residuals_[0]) / values.of(slope);
    return found.is_finite() ? std::optional(found.value()) : std::nullopt;
  }

  /// Makes r linear in the unknowns, by what stands below its bars if need be.
  bool make_linear(Expression& residual) const {
    const auto linear = made_linear_in(residual, unknowns_);
    if (linear) residual = *linear;
    return linear.has_value();
  }

  const ExpectedSystem& system_;
  std::vector<Expression> accelerations_, unknowns_;
  std::vector<Expression> residuals_;
  RightMotion right_;
  std::uint64_t seed_;
  double tolerance_;
  bool values_decide_{};
  bool is_rounded_{};
};

/// The multipliers of free sign that the equations speak of.
std::vector<Expression> free_signs(const ExpectedSystem& system, std::span<const Expression> residuals) {
  std::vector<Expression> multipliers = system.plain_multipliers();
  std::erase_if(multipliers, [&](const Expression& lambda) {
    return std::ranges::none_of(residuals, [&](const Expression& r) { return depends_on(r, lambda); });
  });
  return multipliers;
}

/// The equations with the signs of some multipliers changed, those whose bit is set.
std::vector<Expression> with_signs(std::span<const Expression> residuals,
                                   std::span<const Expression> multipliers, std::size_t bits) {
  std::vector<Replacement> changed;
  for (std::size_t j = 0; j < multipliers.size(); ++j) {
    if ((bits >> j) % 2 == 1) changed.emplace_back(multipliers[j], -multipliers[j]);
  }
  std::vector<Expression> result;
  for (const Expression& residual : residuals) result.push_back(substitute(residual, changed));
  return result;
}

}  // namespace

MotionVerdict compare_motion(const ExpectedSystem& system, std::span<const Expression> residuals,
                             std::optional<std::size_t> coordinate, std::uint64_t seed, double tolerance) {
  const auto compared = [&](std::span<const Expression> equations) {
    return MotionComparison(system, equations, seed, tolerance).verdict(coordinate);
  };
  const MotionVerdict as_written = compared(residuals);
  if (as_written.fault != MotionFault::not_true) return as_written;
  constexpr std::size_t most_signs = 5;
  const std::vector<Expression> multipliers = free_signs(system, residuals);
  if (multipliers.size() > most_signs) return as_written;
  for (std::size_t bits = 1; bits >> multipliers.size() == 0; ++bits) {
    const MotionVerdict other = compared(with_signs(residuals, multipliers, bits));
    if (other.fault != MotionFault::not_true) return other;
  }
  return as_written;
}

}  // namespace qdot
