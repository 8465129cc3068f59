#pragma once
// How small an absolute tolerance has to be beside the relative one, for steps to resolve a motion whose
// numbers are all far below 1, as lengths of atoms in metres are: atol <= rtol size.

#include <algorithm>
#include <cmath>
#include <span>

#include "core/dynamics/dynamics.hpp"
#include "core/motion/simulation_request.hpp"

namespace qdot {

inline constexpr double least_size = 1e-200;  ///< that is resolved: room for underflow

/// The largest of the numbers of a start; 1 where all are 0, and nothing is known.
[[nodiscard]] inline double resolved_size(std::span<const double> y) {
  double largest = 0;
  for (const double x : y) largest = std::max(largest, std::abs(x));
  return largest > 0 ? std::max(largest, least_size) : 1;
}

/// Of a start where all is 0: the largest term that the motion's series has by the time in which high ones
/// would be as large as those before, if that is less than a size of 1 resolves. Infinite otherwise.
[[nodiscard]] double small_size_from_rest(const Dynamics& dynamics, const SimulationRequest& request);

}  // namespace qdot
