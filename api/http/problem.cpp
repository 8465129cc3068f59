#include "api/http/problem.hpp"

#include <algorithm>
#include <array>

#include "api/json/limits.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

using enum ProblemKind;

constexpr auto types = std::to_array<ProblemType>({
    {invalid_json, "invalid-json", 400, "The body is not JSON",
     "The body breaks the grammar of JSON (RFC 8259) at the byte that the detail names. A request is one "
     "object."},
    {invalid_target, "invalid-target", 400, "The address cannot be read",
     "A % in a path or query is followed by two hexadecimal digits, and the result is UTF-8."},
    {unauthorized, "unauthorized", 401, "A token is wanted",
     "The service was started with a token. Send it: Authorization: Bearer <token>."},
    {forbidden_origin, "forbidden-origin", 403, "Requests from this origin are not allowed",
     "A page of another site asked a browser to send this request. Open the page from this service's own "
     "address, or send the request without a browser, as curl and scripts do. Where a proxy gives the service "
     "another name, start it with --allowed-hosts and that name."},
    {not_found, "not-found", 404, "There is nothing at this address", "GET / lists what there is."},
    {method_not_allowed, "method-not-allowed", 405, "This address does not know the method",
     "The Allow header has the methods that it knows."},
    {not_acceptable, "not-acceptable", 406, "None of the accepted media types can be sent",
     "Every answer comes as application/json; trajectories also as text/csv."},
    {request_timeout, "request-timeout", 408, "The request did not arrive in time",
     "Head and body of a request have to arrive within seconds. Send it again."},
    {length_required, "length-required", 411, "The request needs a Content-Length",
     "Bodies are sent whole, with their length; not in chunks. A POST without a body asks for nothing: send "
     "JSON, curl -d '{\"system\": ...}', or use GET with a query."},
    {payload_too_large, "payload-too-large", 413, "The body is too large", "GET /v1/limits has the sizes."},
    {target_too_long, "target-too-long", 414, "The address is too long",
     "Send the request as a POST with a body."},
    {unsupported_media_type, "unsupported-media-type", 415, "The body is not of a type that can be read",
     "Send JSON in UTF-8 with Content-Type: application/json, uncompressed."},
    {expectation_failed, "expectation-failed", 417, "The Expect header is not supported",
     "Send the body without waiting: curl -H 'Expect:'."},
    {misdirected_request, "misdirected-request", 421, "This service is not called by that Host",
     "On a loopback address the Host must be localhost, 127.0.0.1 or [::1], or a name given to "
     "--allowed-hosts."},
    {invalid_request, "invalid-request", 422, "The request does not fit the schema",
     "Each entry of `errors` names one field, what is wrong with it and, where something is close, what was "
     "probably meant. All of them are listed at once."},
    {not_applicable, "not-applicable", 422, "The question does not apply to this system",
     "The request is well formed, but the system has nothing that would answer it; the detail says why."},
    {limit_exceeded, "limit-exceeded", 422, "This is more than is allowed",
     "GET /v1/limits has the limits. Ask in several requests."},
    {integration_failed, "integration-failed", 422, "The motion could not be computed to its end",
     "`reason` is step-limit, nonfinite, singular-mass, tolerance or blow-up; `t_reached` and `last_state` "
     "say how far the solution is good."},
    {headers_too_large, "headers-too-large", 431, "The header fields are too large",
     "A request has at most 64 header fields and 16 KiB of them."},
    {internal, "internal", 500, "The service made a mistake",
     "This is a defect of the service and not of the request. Please report it with the request."},
    {overloaded, "overloaded", 503, "Too much is waiting already",
     "Send the request again after Retry-After."},
    {draining, "draining", 503, "The service is shutting down", "Send the request to another instance."},
    {deadline, "deadline", 503, "The answer took too long",
     "The time for one answer ran out on this machine at this moment. Send it again after Retry-After, or "
     "ask for less: a shorter motion, a larger rtol."},
});

constexpr bool in_order_of_the_enumeration() {
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (static_cast<std::size_t>(types[i].kind) != i) return false;
  }
  return true;
}
static_assert(in_order_of_the_enumeration());

Json to_json(const FieldError& error) {
  Json result = Json::object();
  if (!error.pointer.empty()) result["pointer"] = error.pointer;
  if (!error.parameter.empty()) result["parameter"] = error.parameter;
  result["code"] = error.code;
  result["detail"] = error.detail;
  if (!error.did_you_mean.empty()) result["did_you_mean"] = error.did_you_mean;
  if (!error.allowed.empty()) result["allowed"] = error.allowed;
  return result;
}

}  // namespace

std::span<const ProblemType> problem_types() { return types; }

const ProblemType& problem_type(ProblemKind kind) { return types[static_cast<std::size_t>(kind)]; }

const ProblemType* find_problem_type(std::string_view name) {
  const auto found = std::ranges::find(types, name, &ProblemType::name);
  return found == types.end() ? nullptr : &*found;
}

Problem invalid_request(std::vector<FieldError> errors) {
  const std::size_t count = errors.size();
  std::string detail = count == 1 ? "1 field is wrong." : std::to_string(count) + " fields are wrong.";
  if (count > limits::listed_errors) {
    errors.resize(limits::listed_errors);
    const std::string listed = std::to_string(limits::listed_errors);
    detail = "More than " + listed + " fields are wrong; the first " + listed + " are listed.";
  }
  return {.kind = ProblemKind::invalid_request, .detail = std::move(detail), .errors = std::move(errors)};
}

Response to_response(const Problem& problem, std::string_view path, Layout layout) {
  const ProblemType& type = problem_type(problem.kind);
  Json body = Json::object();
  body["type"] = "/errors/" + std::string(type.name);
  body["title"] = type.title;
  body["status"] = type.status;
  body["detail"] = problem.detail;
  body["instance"] = printable(path, 100);
  body.update(problem.members);
  if (!problem.errors.empty()) {
    Json& errors = body["errors"] = Json::array();
    for (const FieldError& error : problem.errors) errors.push_back(to_json(error));
  }
  return {.status = type.status, .content_type = "application/problem+json", .body = to_text(body, layout)};
}

}  // namespace qdot::api
