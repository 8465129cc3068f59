#pragma once
// Taylor coefficients of a motion on the tape of its accelerations: y' = (v, a(t, q, v)) for y = (q, v).
//
// Every slot becomes a power series in the time since t, and every instruction the recurrence that gives its
// coefficient k from coefficients up to k of its operands: Cauchy products for products, and for the others
// what follows from f(u)' = f'(u) u'. A linear system M x = f needs only M_0 inverted: M_0 x_k = f_k -
// sum_{j>=1} M_j x_{k-j}. abs and sign have the series of the side they are on. Sources: Jorba, Zou, A
// software package for the numerical integration of ODEs by means of high-order Taylor methods, Experimental
// Mathematics 14 (2005) 99, section 2; Griewank, Walther, Evaluating Derivatives, 2nd ed., 13.2.

#include <memory>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/compile/taylor/kernels.hpp"
#include "core/compile/taylor/remainder.hpp"
#include "core/compile/taylor/rounding.hpp"

namespace qdot {

class TaylorTranslation;

/// Which kernels run. Both give the same bits; `automatic` takes the fastest that the processor has.
enum class InstructionSet { automatic, plain };

/// The workspace of one thread. Keeps a reference to the tape.
class TaylorExpansion {
 public:
  static constexpr unsigned highest_order = taylor::highest_order;

  TaylorExpansion(const CompiledFunction& accelerations, std::span<const double> parameters,
                  InstructionSet instruction_set = InstructionSet::automatic);
  ~TaylorExpansion();
  TaylorExpansion(const TaylorExpansion&) = delete;
  TaylorExpansion& operator=(const TaylorExpansion&) = delete;

  /// y_i(t + s) = sum_k coefficients[i (order + 1) + k] s^k, order <= highest_order. Coefficients of a high
  /// order may overflow; what is not ok is the state itself.
  [[nodiscard]] Evaluation expand(double t, std::span<const double> y, unsigned order,
                                  std::span<double> coefficients);

  /// What the polynomials of the last expansion hide until s = h: bounds of |p_i'(s) - f_i(t + s, p(s))| over
  /// 0 <= s <= h, one for each y_i, infinite where none is found (remainder.hpp). Returns the largest of
  /// h defect_i / allowed_i; where nothing is `allowed`, the bounds are the closest there are, and it is
  /// infinite.
  double bound_defect(double h, std::span<const double> allowed, std::span<double> defect);

  /// In place of bound_defect(): looks at the step so closely that its rounding is bounded as well as can be.
  void find_ranges(double h);

  /// What rounding may do to each acceleration over the step whose defect was bounded last (rounding.hpp).
  /// `unit`: of doubles, or of the double-doubles in which somebody else computes the same.
  void bound_rounding(std::span<double> rounding, double unit = taylor::half_unit_of_doubles);

 private:
  friend class PairExpansion;

  taylor::Remainder& remainder();

  const CompiledFunction& tape_;
  taylor::Kernels kernels_;
  Workspace workspace_;
  std::vector<double> accelerations_;
  std::unique_ptr<TaylorTranslation> translation_;
  std::unique_ptr<taylor::Remainder> remainder_;  ///< made when a bound is first asked for
  std::unique_ptr<taylor::Rounding> rounding_;    ///< likewise
  unsigned order_{};                              ///< of the last expansion
};

}  // namespace qdot
