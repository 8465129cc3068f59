#pragma once
// Taylor coefficients of two motions on one tape side by side, each with the bits that it has alone
// (expansion.hpp): of two that go beside each other with other parameters, for little more than one costs.

#include <span>
#include <vector>

#include "core/compile/taylor/expansion.hpp"
#include "core/compile/taylor/pair_translation.hpp"

namespace qdot {

class PairExpansion {
 public:
  static constexpr unsigned highest_order = taylor::highest_order_of_pairs;

  /// Of expansions of one tape that have not expanded anything. Keeps a reference to the tape.
  PairExpansion(const TaylorExpansion& first, const TaylorExpansion& second);

  /// y_i(t + s) = sum_k coefficients[i (order + 1) + k] s^k, order <= highest_order. False where one of both
  /// has to be expanded alone, or has no values.
  [[nodiscard]] bool expand(double t, std::span<const PairOfDoubles> y, unsigned order,
                            std::span<PairOfDoubles> coefficients);

 private:
  const CompiledFunction& tape_;
  taylor::Kernels kernels_;
  PairWorkspace workspace_;
  std::vector<PairOfDoubles> accelerations_;
  PairTranslation translation_;
};

}  // namespace qdot
