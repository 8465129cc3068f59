#pragma once
// A function along a piece of a motion that is known as polynomials: g(t + s, p(s)) as a polynomial in s and
// a bound of the rest,
//
//   |g(t + s, p(s)) - sum_k c_k s^k| <= r    for 0 <= s <= h,
//
// for every p whose components are no farther than given from the polynomials. The coefficients come from the
// recurrences of expansion.hpp, the bound from remainder.hpp. A low order is cheap and often enough to see
// that g has no zero.

#include <memory>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/compile/taylor/kernels.hpp"
#include "core/compile/taylor/remainder.hpp"

namespace qdot {

class TaylorTranslation;

/// The workspace of one thread, for a tape of one output whose variables are q and v.
class TaylorComposition {
 public:
  TaylorComposition(std::shared_ptr<const CompiledFunction> function, std::span<const double> parameters);
  ~TaylorComposition();
  TaylorComposition(const TaylorComposition&) = delete;
  TaylorComposition& operator=(const TaylorComposition&) = delete;

  /// `rows`: rows_order + 1 coefficients of each of (q, v) about t; those beyond `order` count as unknown,
  /// and so do the last digits of the first.   /// Writes order + 1 coefficients of g, order <=
  /// highest_order. Returns r, infinite where there is none.
  double expand(double t, std::span<const double> rows, unsigned rows_order, double h, unsigned order,
                std::span<double> coefficients);

 private:
  /// The state's rows, and what they leave out.
  void put_state(std::span<const double> rows, unsigned rows_order, double h, unsigned order);

  std::shared_ptr<const CompiledFunction> function_;
  Workspace workspace_;
  taylor::Kernels kernels_;
  std::unique_ptr<TaylorTranslation> translation_;
  std::unique_ptr<taylor::Remainder> remainder_;
  std::vector<double> start_, left_out_;
};

}  // namespace qdot
