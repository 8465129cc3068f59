#pragma once
// The addresses whose answers are documents: index, pages, limits, schemas, kinds of problems, systems and
// the practice sheet. What is said of each is in api/about/addresses.

#include <functional>
#include <string>
#include <vector>

#include "api/about/capabilities.hpp"
#include "api/answers/models.hpp"
#include "api/http/routes.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// What the documents tell of. It is shared by their handlers and lives as long as the routes.
struct Documented {
  const Routes& routes;
  const Catalogue& catalogue;
  const std::vector<Page>& pages;
  Models& models;
  std::function<std::string()> metrics;  ///< empty: there is no such address
  Ask ask;                               ///< answers as the service does
};

void add_documents(Routes& routes, const Documented& documented);

}  // namespace qdot::api
