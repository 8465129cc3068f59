#pragma once
// The forces g of a scene at rest as square systems for core/numerics/root_isolation.hpp, one for each way in
// which a place can lie about the kinks u_k (core/steady/kinks.hpp):
//
//   g(x, s) = 0,   s_k = 1 where u_k > 0,  s_k = -1 where u_k < 0,
//   and, for each k in the kinks at which the place is,  u_k(x) = 0  with s_k in [-1, 1] unknown.

#include <optional>
#include <span>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/log_interval.hpp"
#include "core/numerics/root_isolation.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

/// For each kink -1 or 1, the side; 0: at the kink.
using Sides = std::vector<int>;

class ForceSystem {
 public:
  /// `place`: x, from which the coordinates that no force depends on are taken. All must outlive it.
  ForceSystem(const SteadyForces& forces, std::span<const Interval> constants, Box place);

  /// The equations of a chart from now on, instead of all that do not vanish identically. `sizes`: of each x,
  /// what D_k are compared by.
  void use(const Chart& chart, std::span<const double> sizes);
  /// Whether the chart's equations say the same as all of them there; no value where neither they nor those
  /// of another chart may, as all D_k vanish, as far as rounding lets one see.
  [[nodiscard]] std::optional<bool> is_in_chart(std::span<const Interval> unknowns);

  /// All `Sides`; none are at a kink where the forces only bend, as each side has the same zeros there.
  /// Some 3 to the number of kinks.
  [[nodiscard]] std::vector<Sides> patterns() const;

  /// In the unknown x, then the s_k of the kinks at which the place is.
  [[nodiscard]] SquareSystem at(const Sides& sides);
  /// The x of an argument of that system.
  [[nodiscard]] Box place_of(std::span<const Interval> unknowns) const;
  /// Of the sides, for a zero of that system: false where the place is certainly on another one, no value
  /// where that cannot be told.
  [[nodiscard]] std::optional<bool> holds(const Sides& sides, std::span<const Interval> unknowns);

  /// Some force has no value there.
  [[nodiscard]] bool is_pole(const Sides& sides, std::span<const Interval> unknowns);

 private:
  /// The sides are those of the last at().
  std::span<const Interval> arguments(const Sides& sides, std::span<const Interval> unknowns);
  void write_values(const Sides& sides, std::span<const Interval> unknowns, std::span<Interval> out);
  void write_jacobian(const Sides& sides, std::span<const Interval> unknowns, std::span<Interval> out);
  bool excludes(const Sides& sides, std::span<const Interval> unknowns, std::span<const Interval> values);
  [[nodiscard]] bool never_vanishes(std::span<const Interval> variables);
  [[nodiscard]] bool combination_excludes(std::span<const Interval> variables);
  [[nodiscard]] bool kinks_are_apart(const Sides& sides, std::span<const Interval> variables);
  [[nodiscard]] bool is_outside_of_chart(std::span<const Interval> variables);
  /// |D_k| by the sizes of its factors; of the unknowns alone.
  [[nodiscard]] const Box& weighted_determinants(std::span<const Interval> variables);

  const SteadyForces& forces_;
  std::vector<std::size_t> equations_;
  std::size_t chart_{};
  std::vector<double> weights_;  ///< of D_k
  std::size_t n_, kinks_;
  TapeEvaluator<Interval> values_, stiffness_, numerators_, combinations_, arguments_, slopes_, determinants_;
  TapeEvaluator<LogInterval> log_values_, log_numerators_;
  Box variables_;  ///< (x, s)
  Box g_, k_, c_, u_, du_, d_;
};

}  // namespace qdot
