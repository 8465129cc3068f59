#include "api/service.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <new>
#include <utility>

#include "api/about/appraisal.hpp"
#include "api/about/capabilities.hpp"
#include "api/about/documents.hpp"
#include "api/about/openapi.hpp"
#include "api/about/practice_sheet.hpp"
#include "api/about/signposts.hpp"
#include "api/about/systems.hpp"
#include "api/answers/check/variant.hpp"
#include "api/answers/endpoints.hpp"
#include "api/contract/version.hpp"
#include "api/http/address.hpp"
#include "api/http/problem.hpp"
#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"
#include "api/scenes/catalogue.hpp"
#include "api/scenes/scene_table.hpp"
#include "api/scenes/system_lookup.hpp"
#include "core/base/work.hpp"
#include "core/base/work_bounds.hpp"

namespace qdot::api {
namespace {

constexpr std::string_view beyond_memory =
    "The memory of this machine does not hold the answer. Ask for fewer rows at once, or by lines of a batch.";

std::string header(const Request& request, const std::string& name) {
  const auto found = request.headers.find(name);
  return found == request.headers.end() ? "" : found->second;
}

Response no_content(const std::string& allow) { return {.status = 204, .headers = {{"Allow", allow}}}; }

/// A client may keep the answer to a GET and ask whether it still holds, because the same request has the
/// same bytes.
void add_entity_tag(const Request& request, Response& response) {
  const std::string tag = entity_tag(response.body);
  response.headers["ETag"] = tag;
  response.headers["Cache-Control"] = "no-cache";
  response.headers["Vary"] = "Accept";
  if (matches_entity_tag(header(request, "if-none-match"), tag)) {
    response.status = 304;
    response.content_type.clear();
    response.body.clear();
  }
}

}  // namespace

struct Service::Impl {
  explicit Impl(const ServiceOptions& options)
      : metrics(options.metrics), pages(options.pages), catalogue(Catalogue::built_in()) {
    if (!options.scenes_directory.empty()) catalogue = catalogue.with_directory(options.scenes_directory);
    add_documents();
    add_endpoints();
  }

  void get(std::string pattern, Handler handler, std::vector<std::string> offers = {"application/json"},
           Cost cost = {}) {
    routes.add({"GET", std::move(pattern), std::move(handler), std::move(offers), cost});
  }

  /// An address whose answer is one document.
  void get(std::string pattern, Json document) {
    get(std::move(pattern),
        [document = std::move(document)](Call& call) { return json_response(document, call.layout); });
  }

  /// What is said of them is in api/about/addresses.
  void add_documents() {
    add_index();
    add_pages();
    for (const char* probe : {"/healthz", "/livez", "/readyz"}) get(probe, Json{{"status", "ok"}});
    get("/version", Json{{"service_version", service_version()}});
    get("/v1/limits", limits_json());
    const auto answer_scene_schema = [](Call& call) {
      Response response = json_response(scene_schema(), call.layout);
      response.content_type = call.accepted;
      return response;
    };
    get("/v1/scene-schema", answer_scene_schema, {"application/json", "application/schema+json"});
    get("/openapi.json", [this](Call& call) {
      return Response{.content_type = "application/json", .body = openapi(call.layout)};
    });
    if (metrics) {
      const auto answer_metrics = [this](Call& call) {
        return Response{.content_type = call.accepted + "; version=0.0.4", .body = metrics()};
      };
      get("/metrics", answer_metrics, {"text/plain"});
    }
    get("/errors/{name}", answer_problem_type, {"application/json", "text/html"});
    get("/v1/systems", [this](Call& call) { return answer_systems(call); });
    get("/v1/systems/{name}", [this](Call& call) { return answer_system(call); });
    get("/v1/systems/{name}/scene", [this](Call& call) { return answer_scene(call); });
    get("/v1/problems", [](Call& call) { return json_response(exercise_list(), call.layout); });
    get("/v1/problems/{number}", [this](Call& call) { return answer_exercise(call); }, {"application/json"},
        {.milliseconds = 4});
  }

  void add_index() {
    const auto found = std::ranges::find(pages, "/", &Page::path);
    const Page* page = found == pages.end() ? nullptr : &*found;
    std::vector<std::string> offers{"application/json"};
    if (page != nullptr) offers.emplace_back(page->content_type);
    const auto answer_index = [this, page](Call& call) {
      if (page != nullptr && call.accepted == page->content_type) return answer_page(*page);
      return json_response(index_json(routes), call.layout);
    };
    get("/", answer_index, offers);
  }

  /// Pages have addresses of their own; what they consist of is behind one.
  void add_pages() {
    bool has_parts = false;
    for (const Page& page : pages) {
      if (page.path == "/") continue;
      if (page.path.starts_with("/page/")) {
        has_parts = true;
        continue;
      }
      get(std::string(page.path), [&page](Call&) { return answer_page(page); },
          {std::string(page.content_type)});
    }
    if (!has_parts) return;
    get("/page/{file}", [this](Call& call) { return answer_part(call); },
        {"text/javascript", "text/css", "image/svg+xml"});
  }

  Response answer_part(Call& call) {
    const auto found = std::ranges::find(pages, call.target.path, &Page::path);
    return found == pages.end() ? redirected_or_not_found(call) : answer_page(*found);
  }

  static std::vector<std::string> problem_names() {
    std::vector<std::string> names;
    for (const ProblemType& type : problem_types()) names.emplace_back(type.name);
    return names;
  }

  static Response answer_problem_type(Call& call) {
    const ProblemType* type = find_problem_type(call.captures[0]);
    if (type == nullptr)
      return not_found(call, "There is no kind of problem " + in_quotes(call.captures[0]),
                       closest(call.captures[0], problem_names()), "/openapi.json lists them.");
    if (call.accepted == "text/html") return problem_page(*type);
    return json_response(problem_type_json(*type), call.layout);
  }

  Response no_such_system(const Call& call) const {
    return not_found(call, "There is no system " + in_quotes(call.captures[0]),
                     closest(call.captures[0], system_names()),
                     "/v1/systems and /v1/systems?collection=classics list them.");
  }

  std::vector<std::string> system_names() const {
    std::vector<std::string> names = catalogue.names();
    std::ranges::move(classic_names(), std::back_inserter(names));
    return names;
  }

  static FieldError refused_word(const std::string& parameter, std::string code, const std::string& what,
                                 const std::string& word, std::vector<std::string> allowed) {
    return {.parameter = parameter,
            .code = std::move(code),
            .detail = "There is no " + what + " " + in_quotes(word) + ".",
            .did_you_mean = closest(word, allowed),
            .allowed = std::move(allowed)};
  }

  /// Those of the catalogue, unless the query asks for the classics.
  Response answer_systems(Call& call) const {
    std::vector<FieldError> errors;
    std::string collection = "practice";
    for (const auto& [name, value] : call.target.query) {
      if (name != "collection") {
        errors.push_back(refused_word(name, "unknown_field", "field", name, {"collection"}));
      } else if (value != "practice" && value != "classics") {
        errors.push_back(refused_word(name, "not_allowed", "collection", value, {"practice", "classics"}));
      } else {
        collection = value;
      }
    }
    if (!errors.empty())
      return to_response(invalid_request(std::move(errors)), call.target.path, call.layout);
    return json_response(collection == "classics" ? classics_list() : system_list(catalogue), call.layout);
  }

  /// The scene as it is written, ready to be changed and sent.
  Response answer_scene(Call& call) {
    const auto entry = catalogue.find_anywhere(call.captures[0]);
    return entry == nullptr ? no_such_system(call) : json_response(entry->json, call.layout);
  }

  Response answer_system(Call& call) {
    const auto entry = catalogue.find_anywhere(call.captures[0]);
    if (entry == nullptr) return no_such_system(call);
    const Json capabilities = models.remembered(entry->scene, "capabilities", [&] {
      return capabilities_json(*entry, [this](const Request& request) { return answer(request); });
    });
    return json_response(system_description(*entry, capabilities), call.layout);
  }

  Response answer_exercise(Call& call) {
    const auto exercise =
        answered_exercise(call.captures[0], [this](const Request& request) { return answer(request); });
    if (exercise) return json_response(*exercise, call.layout);
    return not_found(call, "The practice sheet has no problem " + in_quotes(call.captures[0]), "",
                     "/v1/problems lists them, 1 to 10.");
  }

  /// POST and its GET twin.
  void add_endpoints() {
    for (const CatalogueEntry& entry : catalogue.entries()) models.add(entry.scene);
    models.add(catalogue.classics());
    const FindSystem find_system = find_system_in(catalogue);
    draw = [this, find_system](std::string_view key, std::uint64_t seed) {
      return drawn_variant(key, seed, find_system, models);
    };
    for (const Endpoint& endpoint : endpoints()) {
      const Handler handler = endpoint.question.handler(find_system, models);
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
  }

  /// It is made when it is first asked for, which the command line seldom does.
  const std::string& openapi(Layout layout) const {
    std::call_once(openapi_is_made, [this] {
      const Json document = openapi_document(routes, catalogue);
      openapi_pretty = to_text(document, Layout::pretty);
      openapi_compact = to_text(document, Layout::compact);
    });
    return layout == Layout::pretty ? openapi_pretty : openapi_compact;
  }

  /// "There is no system 'cart'; did you mean cart_pendulum? /v1/systems lists them." A page where that is
  /// what the client prefers: someone has followed a link.
  static Response not_found(const Call& call, const std::string& what, const std::string& meant,
                            const std::string& rest) {
    Problem problem{.kind = ProblemKind::not_found, .detail = what + "; " + rest};
    if (!meant.empty()) {
      problem.detail = what + "; did you mean " + meant + "? " + rest;
      problem.members = {{"did_you_mean", meant}};
    }
    static const std::vector<std::string> offers{"application/problem+json", "application/json", "text/html"};
    const std::string* accepted = negotiated(header(call.request, "accept"), offers);
    if (accepted == nullptr || *accepted != "text/html")
      return to_response(problem, call.target.path, call.layout);
    Response page = problem_page(problem_type(ProblemKind::not_found), problem.detail);
    page.status = 404;
    page.headers["Vary"] = "Accept";
    restrict_page(page);
    return page;
  }

  /// Nothing is at the path, but something may be near it.
  Response redirected_or_not_found(const Call& call) const {
    const Signpost signpost = signpost_for(call.target.path, routes, catalogue);
    const bool is_elsewhere = signpost.address != call.target.path;
    if (signpost.is_same && is_elsewhere) return moved_to(signpost.address, call);
    return not_found(call, "There is nothing at " + in_quotes(call.target.path),
                     is_elsewhere ? signpost.address : "", "/ lists what there is.");
  }

  Response answer(const Request& request) const {
    std::optional<Target> target = parse_target(request.target);
    if (!target) {
      return to_response({.kind = ProblemKind::invalid_target,
                          .detail = "The address has a % without two hexadecimal digits, or is not UTF-8."},
                         request.target);
    }
    Call call{.request = request, .target = std::move(*target)};
    call.layout = take_layout(call.target);
    Response response = route(call);
    if (const std::string timing = call.timing.header(); !timing.empty()) {
      response.headers["Server-Timing"] = timing;
    }
    return response;
  }

  Response route(Call& call) const {
    const std::string& method = call.request.method;
    if (method == "OPTIONS" && call.request.target == "*") return no_content("GET, HEAD, POST, OPTIONS");
    Routes::Match match = routes.match(method, call.target.path);
    if (match.allow.empty()) return redirected_or_not_found(call);
    if (method == "OPTIONS") return no_content(match.allow);
    if (match.route == nullptr) {
      Response response =
          to_response({.kind = ProblemKind::method_not_allowed, .detail = "Use one of " + match.allow + "."},
                      call.target.path, call.layout);
      response.headers["Allow"] = match.allow;
      return response;
    }
    const std::string* accepted = negotiated(header(call.request, "accept"), match.route->offers);
    if (accepted == nullptr) {
      return to_response({.kind = ProblemKind::not_acceptable,
                          .detail = "This answer comes as " + enumerated(match.route->offers) + "."},
                         call.target.path, call.layout);
    }
    call.accepted = *accepted;
    call.captures = std::move(match.captures);
    Response response = match.route->handler(call);
    restrict_page(response);
    if (match.route->method == "GET" && response.status == 200) add_entity_tag(call.request, response);
    return response;
  }

  [[nodiscard]] Appraisal appraise(const Request& request) const {
    const std::optional<Target> target = parse_target(request.target);
    if (!target) return {};
    const Routes::Match match = routes.match(request.method, target->path);
    return match.route == nullptr ? Appraisal{} : api::appraise(*match.route, request);
  }

  std::function<std::string()> metrics;
  std::vector<Page> pages;
  Catalogue catalogue;
  Models models;
  std::function<std::variant<Json, SheetError>(std::string_view key, std::uint64_t seed)> draw;
  Routes routes;
  mutable std::once_flag openapi_is_made;
  mutable std::string openapi_pretty, openapi_compact;
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
