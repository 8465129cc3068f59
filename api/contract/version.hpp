#pragma once
// The version of the program, which answers, documents, metrics and the log state, so that a number can be
// traced to the code that computed it.

#include <string_view>

namespace qdot::api {

/// As in the answers' `service_version`; the build sets it.
[[nodiscard]] inline std::string_view service_version() { return QDOT_VERSION; }

}  // namespace qdot::api
