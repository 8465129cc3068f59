#include "api/http/dispatch.hpp"

#include <optional>
#include <utility>

#include "api/http/problem.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

/// Every address knows `pretty`: "?pretty" and "?pretty=true" ask for it.
Layout take_layout(Target& target) {
  Layout layout = Layout::compact;
  std::erase_if(target.query, [&](const auto& parameter) {
    const auto& [name, value] = parameter;
    if (name != "pretty") return false;
    layout = value == "false" || value == "0" ? Layout::compact : Layout::pretty;
    return true;
  });
  return layout;
}

Response no_content(const std::string& allow) { return {.status = 204, .headers = {{"Allow", allow}}}; }

Response wrong_method(const Call& call, const std::string& allow) {
  Response response =
      to_response({.kind = ProblemKind::method_not_allowed, .detail = "Use one of " + allow + "."},
                  call.target.path, call.layout);
  response.headers["Allow"] = allow;
  return response;
}

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

Response answer_of(const Route& route, Call& call) {
  const std::string* accepted = negotiated(header(call.request, "accept"), route.offers);
  if (accepted == nullptr) {
    return to_response({.kind = ProblemKind::not_acceptable,
                        .detail = "This answer comes as " + enumerated(route.offers) + "."},
                       call.target.path, call.layout);
  }
  call.accepted = *accepted;
  Response response = route.handler(call);
  restrict_page(response);
  if (route.method == "GET" && response.status == 200) add_entity_tag(call.request, response);
  return response;
}

Response routed(const Routes& routes, Call& call, const Handler& elsewhere) {
  const std::string& method = call.request.method;
  if (method == "OPTIONS" && call.request.target == "*") return no_content("GET, HEAD, POST, OPTIONS");
  Routes::Match match = routes.match(method, call.target.path);
  if (match.allow.empty()) return elsewhere(call);
  if (method == "OPTIONS") return no_content(match.allow);
  if (match.route == nullptr) return wrong_method(call, match.allow);
  call.captures = std::move(match.captures);
  return answer_of(*match.route, call);
}

}  // namespace

std::string header(const Request& request, const std::string& name) {
  const auto found = request.headers.find(name);
  return found == request.headers.end() ? "" : found->second;
}

Response dispatch(const Routes& routes, const Request& request, const Handler& elsewhere) {
  std::optional<Target> target = parse_target(request.target);
  if (!target) {
    return to_response({.kind = ProblemKind::invalid_target,
                        .detail = "The address has a % without two hexadecimal digits, or is not UTF-8."},
                       request.target);
  }
  Call call{.request = request, .target = std::move(*target)};
  call.layout = take_layout(call.target);
  Response response = routed(routes, call, elsewhere);
  if (const std::string timing = call.timing.header(); !timing.empty())
    response.headers["Server-Timing"] = timing;
  return response;
}

void restrict_page(Response& response) {
  if (!response.content_type.starts_with("text/html")) return;
  response.headers["Content-Security-Policy"] =
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; "
      "form-action 'none'; frame-ancestors 'none'";
}

}  // namespace qdot::api
