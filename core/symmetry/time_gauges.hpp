#pragma once
// A force that is the same everywhere and depends on the time, k sin(w t) along x, changes the momentum by
// what it has pushed: m x' + k/w cos(w t) is constant. The change x -> x + s alters L by k sin(w t), which is
// the time derivative of a function F of the time alone (point_change.hpp). Source: Landau, Lifshitz,
// Mechanics, 3rd ed., section 7.

#include <vector>

#include "core/symmetry/point_change.hpp"

namespace qdot {

/// Gauges F(t) for the functions g(t) that stand alone, or with numbers and parameters only, in some dL/dq_i
/// or in a force beside L: the integral of g and that of t g, which a boost needs, where they are elementary
/// (antiderivative.hpp). Those of degree two at most in t are elementary changes already.
[[nodiscard]] std::vector<ElementaryChange> gauges_of_time(const Lagrangian& lagrangian);

}  // namespace qdot
