#include "api/service.hpp"

#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "api/about/appraisal.hpp"
#include "api/about/document_routes.hpp"
#include "api/about/missing.hpp"
#include "api/answers/check/variant.hpp"
#include "api/answers/endpoints.hpp"
#include "api/http/dispatch.hpp"
#include "api/http/problem.hpp"
#include "api/json/limits.hpp"
#include "api/json/writer.hpp"
#include "api/scenes/catalogue.hpp"
#include "api/scenes/system_lookup.hpp"
#include "core/base/work.hpp"
#include "core/base/work_bounds.hpp"

namespace qdot::api {
namespace {

constexpr std::string_view beyond_memory =
    "This machine has too little memory for the answer. Ask for fewer rows at once, or by lines of a batch.";

/// The endpoint at its address and, for each media type that has a suffix, at the address with it.
void add_endpoint(Routes& routes, const Endpoint& endpoint, const Handler& handler) {
  for (const char* method : {"GET", "POST"}) {
    if (endpoint.roads == Roads::body && method == std::string_view("GET")) continue;
    routes.add({method, address_of(endpoint), handler, endpoint.offers, endpoint.cost});
    for (const std::string& type : endpoint.offers) {
      const std::string suffix = suffix_of(endpoint, type);
      if (!suffix.empty())
        routes.add({method, address_of(endpoint) + suffix, handler, {type}, endpoint.cost});
    }
  }
}

}  // namespace

struct Service::Impl {
  explicit Impl(const ServiceOptions& options) : pages(options.pages), catalogue(Catalogue::built_in()) {
    if (!options.scenes_directory.empty()) catalogue = catalogue.with_directory(options.scenes_directory);
    for (const CatalogueEntry& entry : catalogue.entries()) models.add(entry.scene);
    models.add(catalogue.classics());
    add_documents(routes, {.routes = routes,
                           .catalogue = catalogue,
                           .pages = pages,
                           .models = models,
                           .metrics = options.metrics,
                           .ask = [this](const Request& request) { return answer(request); }});
    find_system = find_system_in(catalogue);
    for (const Endpoint& endpoint : endpoints())
      add_endpoint(routes, endpoint, endpoint.question.handler(find_system, models));
  }

  [[nodiscard]] Response answer(const Request& request) const {
    return dispatch(routes, request,
                    [this](Call& call) { return redirected_or_not_found(call, routes, catalogue); });
  }

  [[nodiscard]] Appraisal appraise(const Request& request) const {
    const std::optional<Target> target = parse_target(request.target);
    if (!target) return {};
    const Routes::Match match = routes.match(request.method, target->path);
    return match.route == nullptr ? Appraisal{} : api::appraise(*match.route, request);
  }

  [[nodiscard]] std::variant<Json, SheetError> draw(std::string_view key, std::uint64_t seed) const {
    return drawn_variant(key, seed, find_system, models);
  }

  std::vector<Page> pages;
  Catalogue catalogue;
  mutable Models models;
  Routes routes;
  FindSystem find_system;
};

Service::Service(const ServiceOptions& options) : impl_(std::make_unique<const Impl>(options)) {}
Service::~Service() = default;

Response Service::handle(const Request& request) const noexcept {
  try {
    try {
      const bool is_bounded = request.work == Work::bounded;
      const WorkBoundsScope bounds(is_bounded ? WorkBounds::of_a_service : WorkBounds::none);
      const WorkScope scope(is_bounded ? limits::algebra : std::numeric_limits<std::uint64_t>::max(),
                            request.interrupted);
      return impl_->answer(request);
    } catch (const Interrupted&) {
      Response response = to_response(
          {.kind = ProblemKind::deadline, .detail = "The computation was given up."}, request.target);
      response.headers["Retry-After"] = "1";
      return response;
    } catch (const std::bad_alloc&) {
      if (request.work != Work::bounded)
        return to_response({.kind = ProblemKind::limit_exceeded, .detail = std::string(beyond_memory)}, "");
      Response response =
          to_response({.kind = ProblemKind::overloaded, .detail = "There is no memory left."}, "");
      response.headers["Retry-After"] = "1";
      return response;
    } catch (...) {
      // The text of the exception is not sent, because it may hold library names or the request.
      return to_response({.kind = ProblemKind::internal, .detail = "This should not have happened."},
                         request.target);
    }
  } catch (...) {
    Response bare;  // not even memory for a message
    bare.status = 503;
    return bare;
  }
}

Appraisal Service::appraise(const Request& request) const noexcept {
  try {
    return impl_->appraise(request);
  } catch (...) {
    return {};
  }
}

std::variant<std::string, SheetError> Service::variant(std::string_view key, std::uint64_t seed,
                                                       Layout layout) const {
  const auto drawn = impl_->draw(key, seed);
  if (const auto* error = std::get_if<SheetError>(&drawn)) return *error;
  return to_text(std::get<Json>(drawn), layout);
}

}  // namespace qdot::api
