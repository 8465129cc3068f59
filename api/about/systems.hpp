#pragma once
// GET /v1/systems and /v1/systems/{name}: what can be computed with, as far as the scenes themselves say it.

#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// Name, title and problem of each, in the catalogue's order.
[[nodiscard]] Json system_list(const Catalogue& catalogue);
/// The same of the classics, which are read for it.
[[nodiscard]] Json classics_list();

/// All about one: symbols with unit, default, domain and meaning; events; endings; what it can be asked
/// (api/about/capabilities.hpp); and the scene itself, which a request may carry changed. Defaults are
/// expressions of the parameters, as in the scene.
[[nodiscard]] Json system_description(const CatalogueEntry& entry, const Json& capabilities);

}  // namespace qdot::api
