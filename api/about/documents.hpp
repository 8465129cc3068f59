#pragma once
// The documents that answer without computing: what there is, how much may be asked, what a problem means.

#include <string_view>

#include "api/http/messages.hpp"
#include "api/http/problem.hpp"
#include "api/http/routes.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

[[nodiscard]] Json limits_json();

/// Every address once, in the order of the routes.
[[nodiscard]] Json index_json(const Routes& routes);

/// A problem explained, for programs and for browsers.
[[nodiscard]] Json problem_type_json(const ProblemType& type);
[[nodiscard]] Response problem_page(const ProblemType& type, std::string_view detail = {});

[[nodiscard]] Response answer_page(const Page& page);

}  // namespace qdot::api
