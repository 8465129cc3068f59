#pragma once
// Values that could be meant otherwise than they are read: the answer says how they were understood.

#include <string>

#include "api/contract/symbol.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// A sentence, or an empty text where nothing has to be said. `si` is what was read.
///   theta=30     an angle beyond one turn without a unit: it is in radians, and degrees may be meant;
///   Omega=10 Hz  an angular velocity in turns: 10 Hz are 62.8 rad/s here.
[[nodiscard]] std::string note_on(const Symbol& symbol, const Json& given, double si);

}  // namespace qdot::api
