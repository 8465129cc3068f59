#include "core/grading/same_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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
      if (give_slope(residuals_[k])) continue;
      verdict.equation = k;
      verdict.fault = MotionFault::holds_always;
      return verdict;
    }
    if (coordinate) {
      verdict.fault = fault_of_one(*coordinate);
    } else {
      verdict.fault = system_.has_constraints() ? fault_under_constraints() : fault_of_all();
    }
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
      const bool are_few = std::ranges::any_of(all, [&](const Expression& e) { return has_no_slope(e); });
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

  /// dr/du of every equation at several states of the right motion.
  template <class Use>
  void at_states(Use use) {
    std::vector<Expression> slopes;
    for (const Expression& residual : residuals_) {
      for (const Expression& a : unknowns_) slopes.push_back(differentiate(residual, a));
    }
    BallValues values(slopes);
    SampledStates states(right_.symbols(), seed_ + 1);
    for (int i = 0; i < states_for_slopes; ++i) {
      State state = states.next();
      if (!right_.set(state, values)) continue;
      values.evaluate();
      BallMatrix rows(residuals_.size());
      for (std::size_t k = 0; k < slopes.size(); ++k)
        rows[k / unknowns_.size()].push_back(values.of(slopes[k]));
      use(rows);
    }
  }

  [[nodiscard]] bool has_no_slope(const Expression& residual) const {
    return std::ranges::all_of(unknowns_, [&](const Expression& a) {
      const Expression slope = differentiate(residual, a);
      return slope.is_zero() || zeroness(slope) == Zeroness::zero;
    });
  }

  /// Whether an equation says anything of the unknowns. One of positions or velocities alone that holds on
  /// the surface of constraints holds all the time, and so do its derivatives, which are put in its place.
  [[nodiscard]] bool give_slope(Expression& residual) const {
    constexpr int most_derivatives = 2;
    for (int k = 0; has_no_slope(residual); ++k) {
      if (!system_.has_constraints() || k == most_derivatives) return false;
      residual = total_derivative(residual, system_.symbols().rates());
    }
    return true;
  }

  /// Whether the equation speaks of an acceleration.
  [[nodiscard]] bool has_slope_in(const Expression& acceleration) const {
    const Expression slope = differentiate(residuals_[0], acceleration);
    return !slope.is_zero() && zeroness(slope) != Zeroness::zero;
  }

  /// Which of the right equations an equation is made of.
  struct Parts {
    bool has_own{};     ///< that of the coordinate that was asked for
    bool has_motion{};  ///< that of any coordinate, and not of the constraints alone
    bool is_clear{};    ///< everything could be seen
  };

  Parts parts_of(std::size_t equation, std::size_t coordinate) {
    Parts parts{.is_clear = true};
    int seen = 0;
    at_states([&](const BallMatrix& rows) {
      ++seen;
      const auto c = qdot::solved(transposed(right_.matrix()), rows[equation]);
      for (std::size_t i = 0; i < accelerations_.size(); ++i) {
        const bool is_there = c && !(*c)[i].contains_zero();
        parts.has_motion = parts.has_motion || is_there;
        parts.has_own = parts.has_own || (is_there && i == coordinate);
        parts.is_clear = parts.is_clear && c && (is_there || (*c)[i].magnitude() <= 1e-20);
      }
    });
    parts.is_clear = parts.is_clear && seen >= states_for_slopes / 2;
    return parts;
  }

  /// Of a massless coordinate the right equation itself has no acceleration.
  [[nodiscard]] bool speaks_of(std::size_t coordinate) const {
    return has_slope_in(accelerations_[coordinate]) || system_.matrix()[coordinate][coordinate].is_zero();
  }

  MotionFault fault_of_one(std::size_t coordinate) {
    if (!system_.has_constraints() && !speaks_of(coordinate)) return MotionFault::other_coordinate;
    const Parts parts = parts_of(0, coordinate);
    if (parts.has_own && speaks_of(coordinate)) return MotionFault::none;
    if (parts.has_motion && !speaks_of(coordinate)) return MotionFault::other_coordinate;
    if (!parts.is_clear) return MotionFault::undecided;
    return parts.has_motion ? MotionFault::other_coordinate : MotionFault::of_constraints;
  }

  /// Whether the equations and those of the constraints determine the accelerations and the multipliers that
  /// they speak of.
  MotionFault fault_under_constraints() {
    const std::size_t n = accelerations_.size();
    std::vector<std::size_t> spoken_of(n);
    std::iota(spoken_of.begin(), spoken_of.end(), 0);
    for (std::size_t j = n; j < unknowns_.size(); ++j) {
      const auto speaks = [&](const Expression& residual) { return depends_on(residual, unknowns_[j]); };
      if (std::ranges::any_of(residuals_, speaks)) spoken_of.push_back(j);
    }
    bool is_determined = false;
    at_states([&](const BallMatrix& rows) {
      BallMatrix all = rows;
      const BallMatrix right = right_.matrix();
      all.insert(all.end(), right.begin() + static_cast<std::ptrdiff_t>(n), right.end());
      BallMatrix chosen;
      for (const auto& row : all) {
        chosen.emplace_back();
        for (const std::size_t j : spoken_of) chosen.back().push_back(row[j]);
      }
      is_determined = is_determined || has_full_rank(chosen, spoken_of.size());
    });
    if (is_determined) return MotionFault::none;
    bool is_clear = true, has_motion = false;
    for (std::size_t k = 0; k < residuals_.size(); ++k) {
      const Parts parts = parts_of(k, 0);
      is_clear = is_clear && parts.is_clear;
      has_motion = has_motion || parts.has_motion;
    }
    if (!is_clear) return MotionFault::undecided;
    return has_motion ? MotionFault::undetermined : MotionFault::of_constraints;
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
