#pragma once
// What goes wrong, said in one form on every path: application/problem+json (RFC 9457). A Problem is a value;
// the kinds are one table, which GET /errors/{name} explains.
//
// Text of the request enters a message only through api/json/text.hpp, so no field of an answer repeats more
// than 200 bytes of it, and nothing here quotes a library.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/messages.hpp"
#include "api/json/json.hpp"
#include "api/json/layout.hpp"

namespace qdot::api {

enum class ProblemKind {
  invalid_json,
  invalid_target,
  unauthorized,
  forbidden_origin,
  not_found,
  method_not_allowed,
  not_acceptable,
  request_timeout,
  length_required,
  payload_too_large,
  target_too_long,
  unsupported_media_type,
  expectation_failed,
  misdirected_request,
  invalid_request,
  not_applicable,
  limit_exceeded,
  integration_failed,
  headers_too_large,
  internal,
  overloaded,
  draining,
  deadline,
};

struct ProblemType {
  ProblemKind kind;
  std::string_view name;  ///< the type URI is "/errors/<name>"
  int status;
  std::string_view title;
  std::string_view explanation;  ///< what happened and what to do, for the reader of /errors/<name>
};

/// All kinds, in the order of the enumeration.
[[nodiscard]] std::span<const ProblemType> problem_types();
[[nodiscard]] const ProblemType& problem_type(ProblemKind kind);
/// nullptr for a name that is none.
[[nodiscard]] const ProblemType* find_problem_type(std::string_view name);

/// One mistake in a request.
struct FieldError {
  std::string pointer{};               ///< "#/parameters/kk", in a body; or
  std::string parameter{};             ///< "kk", in a query
  std::string code{};                  ///< unknown_field, wrong_type, out_of_range, ...
  std::string detail{};                ///< one sentence
  std::string did_you_mean{};          ///< or empty
  std::vector<std::string> allowed{};  ///< or empty
};

struct Problem {
  ProblemKind kind{ProblemKind::internal};
  std::string detail{};
  std::vector<FieldError> errors{};
  Json members = Json::object();  ///< more of the problem's own: reason, t_reached, last_state
};

/// The problem that says "2 fields are wrong." and lists them; of very many, the first few.
[[nodiscard]] Problem invalid_request(std::vector<FieldError> errors);

/// `path` becomes the problem's `instance`.
[[nodiscard]] Response to_response(const Problem& problem, std::string_view path,
                                   Layout layout = Layout::compact);

}  // namespace qdot::api
