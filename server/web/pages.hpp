#pragma once
// The pages for browsers, which are inside the program.

#include <vector>

#include "api/http/messages.hpp"
#include "api/json/embedded_file.hpp"

namespace qdot::server::web {

/// The files of this directory.
[[nodiscard]] std::span<const api::EmbeddedFile> page_files();

[[nodiscard]] std::vector<api::Page> pages();

}  // namespace qdot::server::web
