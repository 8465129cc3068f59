#pragma once
// Whether answers that fit a JSON Schema can have anything at a JSON Pointer.

#include <optional>
#include <string>

#include "api/contract/submission.hpp"
#include "api/http/problem.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// The error of a pointer that leads nowhere in any answer, or to an object or array instead of a value; its
/// place is `place`. None where an answer may have it: what the schema leaves open is allowed.
[[nodiscard]] std::optional<FieldError> place_in_schema(const Json& schema, const std::string& pointer,
                                                        const Place& place);

}  // namespace qdot::api
