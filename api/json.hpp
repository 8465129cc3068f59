#pragma once
// The one JSON type of this room. Objects keep the order in which they were written, so that a scene reads
// the same on the way out and an answer's fields come in the order that the code gives them.

#include <nlohmann/json.hpp>

namespace qdot::api {

using Json = nlohmann::ordered_json;

}  // namespace qdot::api
