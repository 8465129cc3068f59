#pragma once
// Terms c_k h^k of a step's polynomials. What is no number is passed over where the largest is looked for.

#include <span>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/numerics/pairs.hpp"

namespace qdot {

class StepTerms {
 public:
  explicit StepTerms(std::size_t components) : largest_(components) {}

  void take(const MotionPiece& step);

  /// The largest |c_k| h^k of each component, or what they come to where the step ends, if that is larger: so
  /// it is of what grows as exp(t).
  [[nodiscard]] std::span<const double> largest() const { return largest_; }

  template <class Number>
  struct Difference {
    Number sum{};      ///< from k = 1 on, in their order
    Number largest{};  ///< magnitude
  };
  /// Turns c_k into (own_k - c_k) h^k for 1 <= k <= order. The largest is `least` at least.
  Difference<double> subtract(const double* own, unsigned order, double least, double* c) const;
  /// The same of two series side by side.
  Difference<PairOfDoubles> subtract(const double* own, unsigned order, PairOfDoubles least,
                                     PairOfDoubles* c) const;

 private:
  std::vector<double> powers_;  ///< h^k, each the one before times h
  std::vector<double> largest_;
};

}  // namespace qdot
