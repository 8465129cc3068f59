#pragma once
// The one impact of a scene as functions of the state y = (q, q') just before it, in SI units: the state just
// after it, and g, on whose surface g(y) = 0 it happens.

#include <Eigen/Core>
#include <vector>

#include "core/dynamics/dynamics.hpp"

namespace qdot {

struct ImpactFunctions {
  std::vector<Eigen::Index> components;  ///< of the state before it, those on which the state after depends
  CompiledFunction jump;                 ///< the state after it, then its derivative by each of these
  CompiledFunction surface;              ///< g, then dg/dy
};

/// The model has one impact.
[[nodiscard]] ImpactFunctions impact_functions(const Dynamics& dynamics);

/// The event at which it happens.
[[nodiscard]] const ParsedSceneEvent& impact_event(const Model& model);

}  // namespace qdot
