#pragma once
// POST and GET /v1/turning_points: how far a coordinate goes.

#include <optional>
#include <string>

#include "api/answers/simulate_request.hpp"
#include "api/contract/request_table.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

struct TurningPointsRequest {
  SystemChoice system{};
  std::string coordinate{};  ///< empty: the only one left after the ignorable ones
  double t_start{};
  std::optional<double> t_end{};  ///< where the motion must be followed
  OnInvalid on_invalid{OnInvalid::stop};
  bool impacts{true};
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<TurningPointsRequest>& turning_points_table();

}  // namespace qdot::api
