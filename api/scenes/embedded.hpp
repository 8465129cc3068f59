#pragma once
// The scenes of the catalogue and of the classics inside the program, each the text of its JSON file.

#include "api/json/embedded_file.hpp"

namespace qdot::api {

/// systems/*.json, in the order of their names.
[[nodiscard]] std::span<const EmbeddedFile> system_files();

/// classics/*.json, in the order of their names, each the name of its system.
[[nodiscard]] std::span<const EmbeddedFile> classic_files();

}  // namespace qdot::api
