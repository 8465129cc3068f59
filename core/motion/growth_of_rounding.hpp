#pragma once
// What a motion makes of rounding: two computations in doubles, one from parameters and initial values that
// differ in their last digits from those of the other, are apart by e,
//
//   e' = df/dy e + df/dp dp + what rounding of f does to either,   e(0) = dy,
//
// and no tolerance brings a computation nearer to the motion than that. Where the motion amplifies e, a few
// steps may make it: those through a place where terms of f cancel. Along the steps of a computation that is
// there already it is followed by Taylor series of low order from both places, whose truncation is the same
// and drops out. One sample, good to a factor of some units.

#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/integrate/run.hpp"

namespace qdot {

/// A computed motion from (t_start, y_start), and where the one beside it begins.
struct Neighbours {
  std::span<const double> parameters{}, moved_parameters{};
  std::vector<double> moved_by{};  ///< dy
  const StepEnds& steps;
  double t_start{};
  std::span<const double> y_start{};
};

/// The largest |e| of each component; up to where the series have no values.
[[nodiscard]] std::vector<double> growth_of_rounding(const CompiledFunction& accelerations,
                                                     const Neighbours& neighbours);

}  // namespace qdot
