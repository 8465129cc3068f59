#pragma once
// What is said where nothing answers: 404 with the nearest name, or 308 to the address that was meant.

#include <string>

#include "api/http/routes.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// "There is no system 'cart'; did you mean cart_pendulum? /v1/systems lists them." A page where that is what
/// the client prefers: someone has followed a link. `meant` may be empty.
[[nodiscard]] Response not_found(const Call& call, const std::string& what, const std::string& meant,
                                 const std::string& rest);

/// Nothing is at the path, but something may be near it.
[[nodiscard]] Response redirected_or_not_found(const Call& call, const Routes& routes,
                                               const Catalogue& catalogue);

}  // namespace qdot::api
