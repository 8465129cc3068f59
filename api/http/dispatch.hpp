#pragma once
// From a request to the function that answers it, and what HTTP asks of every answer (RFC 9110): OPTIONS and
// Allow, media types, entity tags.

#include <string>

#include "api/http/routes.hpp"

namespace qdot::api {

/// Of a name in lower case; empty where it was not sent.
[[nodiscard]] std::string header(const Request& request, const std::string& name);

/// By the route of its method and path; `elsewhere` answers where no route has the path. Server-Timing says
/// how long the parts of an answer took.
[[nodiscard]] Response dispatch(const Routes& routes, const Request& request, const Handler& elsewhere);

/// A page fetches nothing from elsewhere, is shown in no frame, and runs no program but its own.
void restrict_page(Response& response);

}  // namespace qdot::api
