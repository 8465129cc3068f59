#include "core/grading/linear_equations.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/expr/zeroness.hpp"
#include "core/grading/ball_system.hpp"

namespace qdot {
namespace {

constexpr int states_for_slopes = 12;

class LinearEquations {
 public:
  LinearEquations(const ExpectedSystem& system, RightMotion& right, std::span<const Expression> residuals,
                  std::uint64_t seed)
      : system_(system),
        right_(right),
        residuals_(residuals),
        accelerations_(system.symbols().coordinates.second_rate),
        unknowns_(system.unknowns()),
        seed_(seed) {}

  MotionFault fault(std::optional<std::size_t> coordinate) {
    if (coordinate) return fault_of_one(*coordinate);
    return system_.has_constraints() ? fault_under_constraints() : fault_of_all();
  }

 private:
  /// dr/du of every equation at several states of the right motion.
  template <class Use>
  void at_states(Use use) {
    std::vector<Expression> slopes;
    for (const Expression& residual : residuals_) {
      for (const Expression& a : unknowns_) slopes.push_back(differentiate(residual, a));
    }
    BallValues values(slopes);
    SampledStates states(right_.symbols(), seed_);
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
  RightMotion& right_;
  std::span<const Expression> residuals_;
  std::vector<Expression> accelerations_, unknowns_;
  std::uint64_t seed_;
};

}  // namespace

bool has_no_slope(const Expression& residual, std::span<const Expression> unknowns) {
  return std::ranges::all_of(unknowns, [&](const Expression& a) {
    const Expression slope = differentiate(residual, a);
    return slope.is_zero() || zeroness(slope) == Zeroness::zero;
  });
}

MotionFault fault_of_linear(const ExpectedSystem& system, RightMotion& right,
                            std::span<const Expression> residuals, std::optional<std::size_t> coordinate,
                            std::uint64_t seed) {
  return LinearEquations(system, right, residuals, seed).fault(coordinate);
}

}  // namespace qdot
