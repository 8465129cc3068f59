#pragma once
// Taylor coefficients of a motion in double-doubles, on the tape of its accelerations: y' = (v, a(t, q, v))
// for y = (q, v), as core/compile/taylor/expansion.hpp has them in doubles.
//
// Functions follow from their differential equations: (sin u)' = u' cos u, (exp u)' = u' exp u,
// (log u)' = u'/u, (u^c)' = c u' u^c/u, (tan u)' = u' (1 + tan^2 u), (asin u)' = u'/sqrt(1 - u^2),
// (atan u)' = u'/(1 + u^2).

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "core/compile/extended/kernels.hpp"
#include "core/compile/extended/tape.hpp"
#include "core/compile/taylor/expansion.hpp"

namespace qdot {

class ExtendedTranslation;

/// Whether every instruction has a recurrence here: all but abs and sign do.
[[nodiscard]] bool has_extended_expansion(const CompiledFunction& accelerations);

/// The workspace of one thread. Keeps a reference to the tape. Throws std::invalid_argument for a tape that
/// has no extended expansion.
class ExtendedExpansion {
 public:
  static constexpr unsigned highest_order = extended::highest_order;

  ExtendedExpansion(const CompiledFunction& accelerations, std::span<const DoubleDouble> parameters,
                    InstructionSet instruction_set = InstructionSet::automatic);
  ~ExtendedExpansion();
  ExtendedExpansion(const ExtendedExpansion&) = delete;
  ExtendedExpansion& operator=(const ExtendedExpansion&) = delete;

  /// y_i(t + s) = sum_k coefficients[i (order + 1) + k] s^k, 1 <= order <= highest_order.
  [[nodiscard]] Evaluation expand(const DoubleDouble& t, std::span<const DoubleDouble> y, unsigned order,
                                  std::span<DoubleDouble> coefficients);

 private:
  ExtendedTape tape_;
  extended::Kernel kernel_;
  std::unique_ptr<ExtendedTranslation> translation_;
};

/// The same with the coefficients of order 6 and more in doubles. These are multiplied by the sixth power of
/// a step that is short beside the series' radius, so that their rounding is far below that of doubles: a
/// motion takes twice to three times the work of one in doubles, and its round-off is that of
/// double-doubles.
class MixedExpansion {
 public:
  static constexpr unsigned first_in_doubles = 6;

  MixedExpansion(const CompiledFunction& accelerations, std::span<const DoubleDouble> parameters);

  /// As ExtendedExpansion::expand, order <= TaylorExpansion::highest_order.
  [[nodiscard]] Evaluation expand(const DoubleDouble& t, std::span<const DoubleDouble> y, unsigned order,
                                  std::span<DoubleDouble> coefficients);

  /// As TaylorExpansion::bound_defect, of the series in doubles through (t, y) of the order of the last
  /// expansion: mostly it is that one. Infinite where there is none.
  [[nodiscard]] double bound_defect(double t, std::span<const double> y, double h,
                                    std::span<const double> allowed, std::span<double> defect);
  /// As TaylorExpansion::bound_rounding, over the step that was bounded last.
  void bound_rounding(std::span<double> rounding, double unit) { others_.bound_rounding(rounding, unit); }

 private:
  [[nodiscard]] Evaluation expand_in_doubles(double t, std::span<const double> y, unsigned order);

  ExtendedExpansion first_;
  TaylorExpansion others_;
  std::vector<DoubleDouble> first_coefficients_;
  std::vector<double> y_, other_coefficients_;
  double t_{};  ///< of the last series in doubles, as y_
  unsigned order_{TaylorExpansion::highest_order};
  bool is_expanded_{false};  ///< there is one
};

}  // namespace qdot
