#pragma once
// Which names a scene may give to its parameters, coordinates, points and so on.

#include <string>
#include <string_view>
#include <vector>

#include "api/contract/field.hpp"

namespace qdot::api {

/// Whether `text` is a name: ASCII letters, digits and underscores after a letter, at most
/// limits::name_bytes; not ending in _dot or _ddot, which say velocity and acceleration, and none of
/// reserved_names(). Where velocities are named too, whether it is such a name with or without _dot.
[[nodiscard]] bool is_name(std::string_view text, NameOf of = NameOf::thing);

/// t, pi and the functions that expressions know.
[[nodiscard]] const std::vector<std::string>& reserved_names();

}  // namespace qdot::api
