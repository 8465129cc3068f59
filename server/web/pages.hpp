#pragma once
// The files of this directory inside the program: the pages for browsers. embed.cmake writes the definition.

#include <vector>

#include "api/service.hpp"

namespace qdot::server::web {

[[nodiscard]] std::vector<api::Page> pages();

}  // namespace qdot::server::web
