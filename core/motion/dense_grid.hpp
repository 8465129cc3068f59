#pragma once
// The instants at which two computations of a motion are compared: those of the request, with others between
// them where these are few.

#include <cstddef>
#include <vector>

#include "core/motion/simulation.hpp"

namespace qdot {

struct DenseGrid {
  std::vector<double> t;         ///< increasing
  std::vector<bool> wanted;      ///< whether the request has it
  std::vector<double> left_out;  ///< what it leaves out of the instant that was typed

  explicit DenseGrid(const SimulationRequest& request);

  /// Leaves the rows that were asked for: of the state, 2n = `width` numbers each, and of `columns` columns.
  void thin(Simulation& simulation, std::size_t width, std::size_t columns) const;
};

}  // namespace qdot
