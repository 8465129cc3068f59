#pragma once
// The table of a request. An endpoint is added by writing its request as a struct and its table once:
//
//   struct EnergyRequest { SystemChoice system; double t{}; std::optional<int> digits; };
//
//   const RequestTable<EnergyRequest> table({
//       system_field<EnergyRequest>(), parameters_field<EnergyRequest>(), initial_field<EnergyRequest>(),
//       number("t", &EnergyRequest::t, {.unit = "s"}, "instant of the state", {.default_value = 0.0}),
//   });
//
// Rules between fields go into a check, a plain function, which sees the typed request.

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "api/contract/findings.hpp"
#include "api/contract/request_reader.hpp"
#include "api/contract/submission.hpp"
#include "api/contract/system_choice.hpp"
#include "api/contract/table.hpp"
#include "api/http/problem.hpp"

namespace qdot::api {

/// A request that was read: typed, and as the echo of the answer.
template <class Request>
struct Resolved {
  Request request{};
  Json echo = Json::object();
};

template <class Request>
using RequestField = BoundField<Request>;

template <class Request>
class RequestTable {
 public:
  using Check = std::function<void(Request&, Findings&)>;

  explicit RequestTable(std::vector<RequestField<Request>> fields, std::vector<OneOf> one_of = {},
                        Check check = {})
      : table_("", "", std::move(fields), std::move(one_of)), check_(std::move(check)) {}

  [[nodiscard]] const FieldSet& set() const { return table_.set(); }

  [[nodiscard]] std::variant<Resolved<Request>, Problem> read(const Submission& submission,
                                                              const FindSystem& find_system) const {
    Reading reading = read_request(set(), submission, find_system);
    Resolved<Request> result;
    if constexpr (requires { result.request.system; }) result.request.system = std::move(reading.system);
    table_.store(reading.resolved, result.request);
    result.echo = std::move(reading.resolved);
    Findings findings(submission.road, result.echo, reading.errors, reading.defaulted, reading.exact);
    if (check_) check_(result.request, findings);
    if (!reading.errors.empty()) return invalid_request(std::move(reading.errors));
    return result;
  }

 private:
  Table<Request> table_;
  Check check_;
};

// What requests say of their system, and other fields that several of them have.

/// Stored by the reader itself: every request has a member `system`.
template <class Request>
RequestField<Request> system_field() {
  return {FieldInfo{.name = "system",
                    .kind = SystemKind{},
                    .description = "the name of a system (GET /v1/systems lists them), or a scene",
                    .need = Need::required,
                    .aliases = {"model", "scene", "problem", "name"}}};
}

template <class Request>
RequestField<Request> symbols_field(SymbolRole role, std::string description,
                                    std::vector<std::string> aliases = {}) {
  return {FieldInfo{.name = field_name(role),
                    .kind = SymbolsKind{role},
                    .description = std::move(description),
                    .default_value = Json::object(),
                    .aliases = std::move(aliases)}};
}

/// `parameter` is the text field that names the parameter.
template <class Request, class Member>
RequestField<Request> parameter_value(std::string name, Member Request::*member, std::string parameter,
                                      std::string description, FieldOptions options = {}) {
  return value(std::move(name), member, ParameterValueKind{std::move(parameter)}, std::move(description),
               std::move(options));
}

template <class Request>
RequestField<Request> parameters_field() {
  return symbols_field<Request>(SymbolRole::parameter,
                                "values of the system's parameters, where not the default",
                                {"params", "constants"});
}

template <class Request>
RequestField<Request> initial_field() {
  return symbols_field<Request>(SymbolRole::initial,
                                "coordinates and velocities at the start, where not the default",
                                {"initial_conditions", "initial_state", "state", "y0", "q0"});
}

template <class Request>
RequestField<Request> inputs_field() {
  return symbols_field<Request>(SymbolRole::input,
                                "the system's functions of time, expressions in t and the parameters",
                                {"forces", "forcing", "input"});
}

template <class Request>
RequestField<Request> digits_field() {
  return integer("digits", &Request::digits, {1, 17},
                 "significant digits of the answer's numbers; all without it",
                 {.aliases = {"precision", "significant_digits"}});
}

}  // namespace qdot::api
