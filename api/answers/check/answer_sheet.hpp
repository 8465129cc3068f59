#pragma once
// A key and what was handed in, each a file of its own, put together to the request of a check.
//
//   key      {"items": [{"id": "q1", "expect": {...}}, ...]}: a request of check without what was submitted
//   answers  {"q1": "55.1deg", ...}, or CSV with a line "id,submitted" first

#include <string>
#include <string_view>
#include <variant>

#include "api/json/json.hpp"

namespace qdot::api {

/// Why the two do not go together: one sentence.
struct SheetError {
  std::string text;
};

/// The request, as a body. An item that has no answer stays without one.
[[nodiscard]] std::variant<Json, SheetError> graded_request(std::string_view key, std::string_view answers);

}  // namespace qdot::api
