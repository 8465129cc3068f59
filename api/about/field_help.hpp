#pragma once
// The fields of a request as plain text, for the command line.

#include <string>

#include "api/contract/field.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// One field after the other: its name, its meaning, what it takes, with unit and bounds, and its default, in
/// lines of at most 100 characters. Ends without a newline.
[[nodiscard]] std::string fields_as_text(const FieldSet& set);

/// What a request may say of a system: its parameters, coordinates, velocities and inputs with unit, default
/// and meaning, in the same form.
[[nodiscard]] std::string symbols_as_text(const Scene& scene);

}  // namespace qdot::api
