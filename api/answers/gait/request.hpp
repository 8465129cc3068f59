#pragma once
// /v1/gait: periodic motions from impact to impact.

#include <optional>

#include "api/answers/endpoint.hpp"
#include "core/gait/gait.hpp"

namespace qdot::api {

struct GaitRequest {
  SystemChoice system{};
  std::optional<Gait::Kind> gait{};  ///< none: all that are found
  std::optional<int> digits{};
};

/// The long and the short gait have their names by their step times; a single one is "other".
[[nodiscard]] const char* name(Gait::Kind kind);

[[nodiscard]] const RequestTable<GaitRequest>& gait_table();

[[nodiscard]] Endpoint gait_endpoint();

}  // namespace qdot::api
