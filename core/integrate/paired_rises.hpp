#pragma once
// What a step adds to both samples of how far a computation is from the motion (own_errors.hpp), from series
// that are expanded side by side before either of them asks for its own.

#include <functional>
#include <vector>

#include "core/integrate/separation.hpp"

namespace qdot {

class PairedRises {
 public:
  /// Keeps a reference.
  explicit PairedRises(const Originals& originals) : originals_(originals) {}

  /// Tells each what it will ask for, where both have values.
  void find(const MotionPiece& step, const StepTerms& terms, Separation& asked, Separation& rounded);

 private:
  const Originals& originals_;
  std::vector<PairOfDoubles> place_, c_;  ///< scratch
};

}  // namespace qdot
