#pragma once
// A function along a piece of a motion that is known as polynomials: g(t + s, p(s)) as a polynomial in s and
// a bound of the rest,
//
//   |g(t + s, p(s)) - sum_k c_k s^k| <= r    for 0 <= s <= h,
//
// for every p whose components are no farther than given from the polynomials. The coefficients come from the
// recurrences of expansion.hpp, the bound from remainder.hpp. A low order is cheap and often enough to see
// that g has no zero. Where g has a function that hides what its argument is rounded by, as sign and tanh do,
// that is in r (rounding.hpp); of others values tell.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/compile/taylor/kernels.hpp"
#include "core/compile/taylor/remainder.hpp"
#include "core/compile/taylor/rounding.hpp"

namespace qdot {

class TaylorTranslation;

/// What a tape of one output has for variables: (q, v), or (q, v, a).
enum class Variables { state, state_and_accelerations };

/// The workspace of one thread.
class TaylorComposition {
 public:
  TaylorComposition(std::shared_ptr<const CompiledFunction> function, std::span<const double> parameters,
                    Variables variables = Variables::state);
  ~TaylorComposition();
  TaylorComposition(const TaylorComposition&) = delete;
  TaylorComposition& operator=(const TaylorComposition&) = delete;

  /// `rows`: rows_order + 1 coefficients of each of (q, v) about t; those beyond `order` count as unknown,
  /// and so do the last digits of the first. Accelerations are the slopes of v within `defect`, the second
  /// half of its numbers. Writes order + 1 coefficients of g, order <= highest_order. Returns r, infinite
  /// where there is none, and no number where g has no value in all of the piece.
  double expand(double t, std::span<const double> rows, unsigned rows_order, double h, unsigned order,
                std::span<double> coefficients, std::span<const double> defect = {});

 private:
  /// The rows of the variables, and what they leave out.
  void put_variables(std::span<const double> rows, unsigned rows_order, double h, unsigned order,
                     std::span<const double> defect);
  template <class Coefficient>
  void put(std::size_t variable, unsigned last, unsigned order, const Coefficient& c);

  std::shared_ptr<const CompiledFunction> function_;
  Workspace workspace_;
  taylor::Kernels kernels_;
  std::unique_ptr<TaylorTranslation> translation_;
  std::unique_ptr<taylor::Remainder> remainder_;
  std::unique_ptr<taylor::Rounding> rounding_;  ///< null where values tell
  std::size_t coordinates_;
  std::vector<double> start_, left_out_;
  std::array<double, taylor::highest_order + 1> powers_{};  ///< h^k
};

}  // namespace qdot
