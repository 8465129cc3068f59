#pragma once
// POST and GET /v1/gait: periodic motions from impact to impact.

#include <optional>

#include "api/contract/request_table.hpp"
#include "api/contract/system_choice.hpp"
#include "core/gait/gait.hpp"

namespace qdot::api {

struct GaitRequest {
  SystemChoice system{};
  std::optional<Gait::Kind> gait{};  ///< none: all that are found
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<GaitRequest>& gait_table();

}  // namespace qdot::api
