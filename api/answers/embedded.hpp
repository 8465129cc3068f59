#pragma once
// The endpoints' JSON files inside the program, which say in OpenAPI's terms what each one answers.

#include "api/json/embedded_file.hpp"

namespace qdot::api {

/// The JSON file of each endpoint's folder.
[[nodiscard]] std::span<const EmbeddedFile> endpoint_files();

}  // namespace qdot::api
