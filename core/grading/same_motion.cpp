#include "core/grading/same_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/expr/linear.hpp"
#include "core/expr/zeroness.hpp"
#include "core/grading/ball_system.hpp"
#include "core/grading/equation_size.hpp"
#include "core/grading/factored_equations.hpp"
#include "core/grading/linear_in.hpp"
#include "core/grading/other_solutions.hpp"
#include "core/grading/proven_root.hpp"
#include "core/grading/right_motion.hpp"

namespace qdot {
namespace {

constexpr int states_for_slopes = 12;

class MotionComparison {
 public:
  MotionComparison(const ExpectedSystem& system, std::span<const Expression> residuals, std::uint64_t seed,
                   double tolerance)
      : system_(system),
        accelerations_(system.symbols().coordinates.second_rate),
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
      if (!has_no_slope(residuals_[k])) continue;
      verdict.equation = k;
      verdict.fault = MotionFault::holds_always;
      return verdict;
    }
    verdict.fault = coordinate ? fault_of_one(*coordinate) : fault_of_all();
    return verdict;
  }

 private:
  VanishingAnswer on_the_right_motion(const Expression& residual) {
    std::optional<EquationSize> size;
    if (tolerance_ > 0) size.emplace(system_, right_, residual);
    return vanishing(
        {.value = residual,
         .symbols = right_.symbols(),
         .seed = seed_,
         .complete = [&](const State& state, BallValues& values) { return right_.set(state, values); },
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
  /// equations of the other coordinates stand beside that of one.
  OtherSolutionsAnswer others_of(std::optional<std::size_t> coordinate) {
    std::vector<Expression> all = residuals_;
    if (coordinate) {
      const auto found = other_solutions(system_, right_, residuals_[0], *coordinate, seed_ + 4);
      if (found.found != OtherSolutions::unknown) return found;
      for (std::size_t i = 0; i < accelerations_.size(); ++i) {
        if (i != *coordinate) all.push_back(right_equation(i));
      }
    }
    const auto found = other_solutions_of_factors(system_, right_, all, seed_ + 5);
    if (found.found != OtherSolutions::unknown) return found;
    return proven_other_root(system_, right_, all, seed_ + 6);
  }

  [[nodiscard]] Expression right_equation(std::size_t i) const {
    Expression residual = -system_.forcing()[i];
    for (std::size_t j = 0; j < accelerations_.size(); ++j)
      residual = residual + system_.mass_matrix()[i][j] * accelerations_[j];
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

  /// Makes r linear in the accelerations, by what stands below its bars if need be.
  bool make_linear(Expression& residual) const {
    const auto linear = made_linear_in(residual, accelerations_);
    if (linear) residual = *linear;
    return linear.has_value();
  }

  /// dr/dq'' of every equation at several states of the right motion.
  template <class Use>
  void at_states(Use use) {
    std::vector<Expression> slopes;
    for (const Expression& residual : residuals_) {
      for (const Expression& a : accelerations_) slopes.push_back(differentiate(residual, a));
    }
    BallValues values(slopes);
    SampledStates states(right_.symbols(), seed_ + 1);
    for (int i = 0; i < states_for_slopes; ++i) {
      const State state = states.next();
      if (!right_.set(state, values)) continue;
      for (std::size_t k = 0; k < state.size(); ++k) values.set(right_.symbols()[k].symbol, state[k]);
      values.evaluate();
      BallMatrix rows(residuals_.size());
      for (std::size_t k = 0; k < slopes.size(); ++k)
        rows[k / accelerations_.size()].push_back(values.of(slopes[k]));
      use(rows);
    }
  }

  [[nodiscard]] bool has_no_slope(const Expression& residual) const {
    return std::ranges::all_of(accelerations_, [&](const Expression& a) {
      const Expression slope = differentiate(residual, a);
      return slope.is_zero() || zeroness(slope) == Zeroness::zero;
    });
  }

  /// Whether the equation speaks of an acceleration.
  [[nodiscard]] bool has_slope_in(const Expression& acceleration) const {
    const Expression slope = differentiate(residuals_[0], acceleration);
    return !slope.is_zero() && zeroness(slope) != Zeroness::zero;
  }

  MotionFault fault_of_one(std::size_t coordinate) {
    if (!has_slope_in(accelerations_[coordinate])) return MotionFault::other_coordinate;
    bool is_determined = false, is_unclear = false;
    int seen = 0;
    at_states([&](const BallMatrix& rows) {
      ++seen;
      const auto c = qdot::solved(transposed(right_.mass()), rows[0]);
      if (!c) {
        is_unclear = true;
      } else if (!(*c)[coordinate].contains_zero()) {
        is_determined = true;
      } else if ((*c)[coordinate].magnitude() > 1e-20) {
        is_unclear = true;
      }
    });
    if (is_determined) return MotionFault::none;
    const bool is_clear = !is_unclear && seen >= states_for_slopes / 2;
    return is_clear ? MotionFault::other_coordinate : MotionFault::undecided;
  }

  MotionFault fault_of_all() {
    bool is_determined = false;
    int dependent = 0;
    at_states([&](const BallMatrix& rows) {
      is_determined = is_determined || qdot::solved(rows, std::vector<Ball>(rows.size()));
      dependent += is_singular(rows) ? 1 : 0;
    });
    if (is_determined) return MotionFault::none;
    return are_dependent() || dependent == states_for_slopes ? MotionFault::dependent
                                                             : MotionFault::undecided;
  }

  /// Whether det dr/dq'' vanishes identically.
  [[nodiscard]] bool are_dependent() const {
    if (residuals_.size() > largest_written_system) return false;
    Matrix slopes;
    for (const Expression& residual : residuals_) {
      slopes.emplace_back();
      for (const Expression& a : accelerations_) slopes.back().push_back(differentiate(residual, a));
    }
    const Expression found = determinant(slopes);
    return found.is_zero() || zeroness(found) == Zeroness::zero;
  }

  const ExpectedSystem& system_;
  std::vector<Expression> accelerations_;
  std::vector<Expression> residuals_;
  RightMotion right_;
  std::uint64_t seed_;
  double tolerance_;
  bool values_decide_{};
  bool is_rounded_{};
};

}  // namespace

MotionVerdict compare_motion(const ExpectedSystem& system, std::span<const Expression> residuals,
                             std::optional<std::size_t> coordinate, std::uint64_t seed, double tolerance) {
  return MotionComparison(system, residuals, seed, tolerance).verdict(coordinate);
}

}  // namespace qdot
