#pragma once
// The systems that requests speak of: those of the catalogue by name, and scenes that a request carries.

#include "api/contract/system_choice.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// Finds systems in `catalogue`, which must outlive the function and its results. A scene in a request is
/// read as one in a file is; its mistakes are errors of the request, each with its place.
[[nodiscard]] FindSystem find_system_in(const Catalogue& catalogue);

}  // namespace qdot::api
