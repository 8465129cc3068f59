#pragma once
// A key and what was handed in, each a file of its own, put together to the request of a check.
//
//   key      {"items": [{"id": "q1", "expect": {...}}, ...]}: a request of check without what was submitted
//            or a variant of one (variant.hpp); of a key with ranges, the original
//   answers  {"q1": "55.1deg", ...}, or CSV with a line "id,submitted" first

#include <string_view>
#include <variant>

#include "api/answers/check/sheet_error.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// The request, as a body. An item that has no answer stays without one; a text for which a body has no room
/// is left out as `too_long` (request.hpp) says.
[[nodiscard]] std::variant<Json, SheetError> graded_request(std::string_view key, std::string_view answers);

/// A JSON object, each key once; `name` is what messages call it.
[[nodiscard]] std::variant<Json, SheetError> sheet_object(std::string_view text, const std::string& name,
                                                          std::size_t most_bytes);

}  // namespace qdot::api
