#include "api/about/document_routes.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>
#include <utility>

#include "api/about/documents.hpp"
#include "api/about/missing.hpp"
#include "api/about/openapi.hpp"
#include "api/about/practice_sheet.hpp"
#include "api/about/systems.hpp"
#include "api/contract/answering.hpp"
#include "api/contract/version.hpp"
#include "api/http/problem.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"
#include "api/scenes/scene_table.hpp"

namespace qdot::api {
namespace {

using Shared = std::shared_ptr<const Documented>;

void get(Routes& routes, std::string pattern, Handler handler,
         std::vector<std::string> offers = {"application/json"}, Cost cost = {}) {
  routes.add({"GET", std::move(pattern), std::move(handler), std::move(offers), cost});
}

/// An address whose answer is one document.
void get(Routes& routes, std::string pattern, Json document) {
  get(routes, std::move(pattern),
      [document = std::move(document)](Call& call) { return json_response(document, call.layout); });
}

// --- pages ------------------------------------------------------------------------------------------------

/// The page for browsers where there is one, for others the list of addresses.
void add_index(Routes& routes, const Shared& about) {
  const auto found = std::ranges::find(about->pages, "/", &Page::path);
  const Page* page = found == about->pages.end() ? nullptr : &*found;
  std::vector<std::string> offers{"application/json"};
  if (page != nullptr) offers.emplace_back(page->content_type);
  const auto answer_index = [about, page](Call& call) {
    if (page != nullptr && call.accepted == page->content_type) return answer_page(*page);
    return json_response(index_json(about->routes), call.layout);
  };
  get(routes, "/", answer_index, offers);
}

Response answer_part(const Documented& about, const Call& call) {
  const auto found = std::ranges::find(about.pages, call.target.path, &Page::path);
  return found == about.pages.end() ? redirected_or_not_found(call, about.routes, about.catalogue)
                                    : answer_page(*found);
}

/// Pages have addresses of their own; what they consist of is behind one.
void add_pages(Routes& routes, const Shared& about) {
  bool has_parts = false;
  for (const Page& page : about->pages) {
    if (page.path == "/") continue;
    if (page.path.starts_with("/page/")) {
      has_parts = true;
      continue;
    }
    get(routes, std::string(page.path), [&page](Call&) { return answer_page(page); },
        {std::string(page.content_type)});
  }
  if (!has_parts) return;
  get(routes, "/page/{file}", [about](Call& call) { return answer_part(*about, call); },
      {"text/javascript", "text/css", "image/svg+xml"});
}

// --- the service ------------------------------------------------------------------------------------------

/// The description of the service as text. It is made when it is first asked for, which the command line
/// seldom does.
class OpenapiText {
 public:
  const std::string& in(Layout layout, const Documented& about) {
    std::call_once(is_made_, [&] {
      const Json document = openapi_document(about.routes, about.catalogue);
      pretty_ = to_text(document, Layout::pretty);
      compact_ = to_text(document, Layout::compact);
    });
    return layout == Layout::pretty ? pretty_ : compact_;
  }

 private:
  std::once_flag is_made_;
  std::string pretty_, compact_;
};

std::vector<std::string> problem_names() {
  std::vector<std::string> names;
  for (const ProblemType& type : problem_types()) names.emplace_back(type.name);
  return names;
}

Response answer_problem_type(Call& call) {
  const ProblemType* type = find_problem_type(call.captures[0]);
  if (type == nullptr)
    return not_found(call, "There is no kind of problem " + in_quotes(call.captures[0]),
                     closest(call.captures[0], problem_names()), "/openapi.json lists them.");
  if (call.accepted == "text/html") return problem_page(*type);
  return json_response(problem_type_json(*type), call.layout);
}

Response answer_scene_schema(Call& call) {
  Response response = json_response(scene_schema(), call.layout);
  response.content_type = call.accepted;
  return response;
}

void add_descriptions(Routes& routes, const Shared& about) {
  for (const char* probe : {"/healthz", "/livez", "/readyz"}) get(routes, probe, Json{{"status", "ok"}});
  get(routes, "/version", Json{{"service_version", service_version()}});
  get(routes, "/v1/limits", limits_json());
  get(routes, "/v1/scene-schema", answer_scene_schema, {"application/json", "application/schema+json"});
  get(routes, "/openapi.json", [about, text = std::make_shared<OpenapiText>()](Call& call) {
    return Response{.content_type = "application/json", .body = text->in(call.layout, *about)};
  });
  if (about->metrics) {
    const auto answer_metrics = [about](Call& call) {
      return Response{.content_type = call.accepted + "; version=0.0.4", .body = about->metrics()};
    };
    get(routes, "/metrics", answer_metrics, {"text/plain"});
  }
  get(routes, "/errors/{name}", answer_problem_type, {"application/json", "text/html"});
}

// --- what can be asked about ------------------------------------------------------------------------------

Response no_such_system(const Documented& about, const Call& call) {
  std::vector<std::string> names = about.catalogue.names();
  std::ranges::move(classic_names(), std::back_inserter(names));
  return not_found(call, "There is no system " + in_quotes(call.captures[0]),
                   closest(call.captures[0], names),
                   "/v1/systems and /v1/systems?collection=classics list them.");
}

FieldError refused_word(const std::string& parameter, std::string code, const std::string& what,
                        const std::string& word, std::vector<std::string> allowed) {
  return {.parameter = parameter,
          .code = std::move(code),
          .detail = "There is no " + what + " " + in_quotes(word) + ".",
          .did_you_mean = closest(word, allowed),
          .allowed = std::move(allowed)};
}

/// Those of the catalogue, unless the query asks for the classics.
Response answer_systems(const Documented& about, const Call& call) {
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
  if (!errors.empty()) return to_response(invalid_request(std::move(errors)), call.target.path, call.layout);
  return json_response(collection == "classics" ? classics_list() : system_list(about.catalogue),
                       call.layout);
}

Response answer_system(const Documented& about, const Call& call) {
  const auto entry = about.catalogue.find_anywhere(call.captures[0]);
  if (entry == nullptr) return no_such_system(about, call);
  const Json capabilities = about.models.remembered(entry->scene, "capabilities",
                                                    [&] { return capabilities_json(*entry, about.ask); });
  return json_response(system_description(*entry, capabilities), call.layout);
}

/// The scene as it is written, ready to be changed and sent.
Response answer_scene(const Documented& about, const Call& call) {
  const auto entry = about.catalogue.find_anywhere(call.captures[0]);
  return entry == nullptr ? no_such_system(about, call) : json_response(entry->json, call.layout);
}

Response answer_exercise(const Documented& about, const Call& call) {
  const auto exercise = answered_exercise(call.captures[0], about.ask);
  if (exercise) return json_response(*exercise, call.layout);
  return not_found(call, "The practice sheet has no problem " + in_quotes(call.captures[0]), "",
                   "/v1/problems lists them, 1 to 10.");
}

void add_systems(Routes& routes, const Shared& about) {
  get(routes, "/v1/systems", [about](Call& call) { return answer_systems(*about, call); });
  get(routes, "/v1/systems/{name}", [about](Call& call) { return answer_system(*about, call); });
  get(routes, "/v1/systems/{name}/scene", [about](Call& call) { return answer_scene(*about, call); });
  get(routes, "/v1/problems", [](Call& call) { return json_response(exercise_list(), call.layout); });
  get(routes, "/v1/problems/{number}", [about](Call& call) { return answer_exercise(*about, call); },
      {"application/json"}, {.milliseconds = 4});
}

}  // namespace

void add_documents(Routes& routes, const Documented& documented) {
  const auto about = std::make_shared<const Documented>(documented);
  add_index(routes, about);
  add_pages(routes, about);
  add_descriptions(routes, about);
  add_systems(routes, about);
}

}  // namespace qdot::api
