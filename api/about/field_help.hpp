#pragma once
// The fields of a request as plain text, for the command line.

#include <string>

#include "api/contract/field.hpp"

namespace qdot::api {

/// One field after the other: its name, its meaning, what it takes, with unit and bounds, and its default, in
/// lines of at most 100 characters. Ends without a newline.
[[nodiscard]] std::string fields_as_text(const FieldSet& set);

}  // namespace qdot::api
