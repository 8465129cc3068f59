#pragma once
// What an answer says of the errors of a motion's columns.

#include <span>
#include <vector>

#include "api/answers/simulate/request.hpp"
#include "api/json/writer.hpp"
#include "core/motion/ladder.hpp"

namespace qdot::api {

/// A motion that was measured, and its table: t, the state, further columns.
struct StatedMotion {
  const SimulateRequest& request;
  const Dynamics& dynamics;
  const Reals& parameters;
  const MeasuredSimulation& measured;
  std::span<const double> grid;
  const std::vector<qdot::Column>& columns;  ///< the further ones
  std::span<const Column> table;
  int digits{};
};

/// Of coordinates and velocities as they are written, and what these errors make of the other columns.
[[nodiscard]] Json stated_errors(const StatedMotion& motion);

[[nodiscard]] Json accuracy_json(const StatedMotion& motion);

}  // namespace qdot::api
