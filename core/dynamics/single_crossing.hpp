#pragma once
// Whether a function of (t, q, q') passes zero no more than once while a motion goes through a box of states:
// where its slope along the motion,
//
//   g' = dg/dt + sum_k dg/dy_k y_k',
//
// keeps one sign in all of the box, by interval arithmetic. Where one sign(u) or abs(u) in it has its kink
// there, and u' keeps one sign, the motion passes u = 0 once: then it is enough that g keeps one sign on each
// side of that, or, where it does not jump, that g' has the same one on both. Proven of the box that is
// given; that the motion stays in it is for whoever gives it. Source of the slopes: Moore, Kearfott, Cloud,
// Introduction to Interval Analysis (2009), chapter 9.

#include <functional>
#include <memory>
#include <span>

#include "core/compile/compiled_function.hpp"
#include "core/numerics/interval.hpp"

namespace qdot {

/// What a motion goes through in a while: its times, states and their rates.
struct MotionBox {
  Interval t;
  std::span<const Interval> y, rates;
};

/// Of a function of one output without `solve`, for any parameters that are nearest to these; null where it
/// has one.
[[nodiscard]] std::function<bool(const MotionBox& box)> single_crossing_of(
    std::shared_ptr<const CompiledFunction> function, std::span<const double> parameters);

}  // namespace qdot
