#pragma once
// /v1/turning_points: the largest and the smallest value of a coordinate along a motion.

#include <optional>
#include <string>

#include "api/answers/endpoint.hpp"
#include "core/dynamics/watch.hpp"

namespace qdot::api {

struct TurningPointsRequest {
  SystemChoice system{};
  std::string coordinate{};  ///< empty: the only one left after the ignorable ones
  double t_start{};
  std::optional<double> t_end{};  ///< where the motion must be followed
  OnInvalid on_invalid{OnInvalid::stop};
  bool impacts{true};
  std::optional<int> digits{};

  Real start{}, end{};  ///< t_start and t_end as they were typed
};

[[nodiscard]] const RequestTable<TurningPointsRequest>& turning_points_table();

[[nodiscard]] Endpoint turning_points_endpoint();

}  // namespace qdot::api
