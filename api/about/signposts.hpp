#pragma once
// Where a path was meant to lead that no route answers: "/simulate", "/v1/turning-points/",
// "/v1/bifurcation".

#include <string>
#include <string_view>

#include "api/http/routes.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

struct Signpost {
  std::string address{};  ///< a path, maybe with a query: "/v1/modes?system=cart_pendulum"; empty: none
  bool is_same{false};    ///< the path is this address, /v1 and hyphens aside
};

[[nodiscard]] Signpost signpost_for(std::string_view path, const Routes& routes, const Catalogue& catalogue);

/// 308 to the address that the call's path is another writing of, its query kept (RFC 9110, 15.4.9: method
/// and body stay).
[[nodiscard]] Response moved_to(const std::string& address, const Call& call);

}  // namespace qdot::api
