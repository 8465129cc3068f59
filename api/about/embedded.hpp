#pragma once

#include "api/json/embedded_file.hpp"

namespace qdot::api {

/// problems.json: the practice sheet; addresses.json: what is said of each address; answers.json: JSON
/// Schemas of answers.
[[nodiscard]] std::span<const EmbeddedFile> about_files();

}  // namespace qdot::api
