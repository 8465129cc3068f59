#pragma once

#include <string_view>

namespace qdot::api {

/// The version of the program, as in the answers' `service_version`.
[[nodiscard]] inline std::string_view service_version() { return QDOT_VERSION; }

}  // namespace qdot::api
