#pragma once
// What a system can be asked. It is found out by asking it: nothing here knows why a question does not apply.

#include <functional>

#include "api/http/messages.hpp"
#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

using Ask = std::function<Response(const Request&)>;

/// "outputs": name and unit of every column that a trajectory can have; "capabilities": the questions that
/// apply, by the last part of their address; "examples": a request that is answered with 200 for each of
/// them.
[[nodiscard]] Json capabilities_json(const CatalogueEntry& entry, const Ask& ask);

}  // namespace qdot::api
