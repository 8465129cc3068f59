#pragma once
// The JSON files of this folder inside the program: what documents say that no endpoint's record has.

#include "api/json/embedded_file.hpp"

namespace qdot::api {

/// openapi.json: what belongs to no single address; practice_sheet.json.
[[nodiscard]] std::span<const EmbeddedFile> about_files();

/// What is said of the addresses that compute nothing, by pattern: {"/v1/systems/{name}": {"summary": ...}}.
[[nodiscard]] std::span<const EmbeddedFile> address_files();

}  // namespace qdot::api
