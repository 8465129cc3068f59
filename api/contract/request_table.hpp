#pragma once
// A FieldSet tied to a struct. An endpoint is added by writing its request as a struct and its table once:
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
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "api/contract/field.hpp"
#include "api/contract/findings.hpp"
#include "api/contract/request_reader.hpp"
#include "api/contract/submission.hpp"
#include "api/contract/system_choice.hpp"
#include "api/http/problem.hpp"

namespace qdot::api {

/// A request that was read: typed, and as the echo of the answer.
template <class Request>
struct Resolved {
  Request request{};
  Json echo = Json::object();
};

template <class Request>
struct RequestField {
  FieldInfo info{};
  /// Puts a resolved value into the struct; empty for the symbols of the system, which it has with the
  /// system.
  std::function<void(Request&, const Json&)> store{};
};

/// The optional parts of a field's description.
struct FieldOptions {
  Json default_value{};
  Need need{Need::optional};
  std::vector<std::string> aliases{};
};

template <class Request>
class RequestTable {
 public:
  using Check = std::function<void(Request&, Findings&)>;

  explicit RequestTable(std::vector<RequestField<Request>> fields, std::vector<OneOf> one_of = {},
                        Check check = {})
      : fields_(std::move(fields)), check_(std::move(check)) {
    for (const RequestField<Request>& field : fields_) set_.fields.push_back(field.info);
    set_.one_of = std::move(one_of);
  }

  [[nodiscard]] const FieldSet& set() const { return set_; }

  [[nodiscard]] std::variant<Resolved<Request>, Problem> read(const Submission& submission,
                                                              const FindSystem& find_system) const {
    Reading reading = read_request(set_, submission, find_system);
    Resolved<Request> result;
    result.request.system = std::move(reading.system);
    for (const RequestField<Request>& field : fields_) {
      const auto value = reading.resolved.find(field.info.name);
      if (field.store && value != reading.resolved.end()) field.store(result.request, *value);
    }
    result.echo = std::move(reading.resolved);
    Findings findings(submission.road, result.echo, reading.errors, reading.defaulted);
    if (check_) check_(result.request, findings);
    if (!reading.errors.empty()) return invalid_request(std::move(reading.errors));
    return result;
  }

 private:
  std::vector<RequestField<Request>> fields_;
  FieldSet set_;
  Check check_;
};

// The kinds of fields. Each takes the member that it fills, T or std::optional<T>.

namespace detail {

template <class T>
struct ValueOf {
  using type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
  using type = T;
};

inline FieldInfo info(std::string name, Kind kind, std::string description, FieldOptions options) {
  return {.name = std::move(name),
          .kind = std::move(kind),
          .description = std::move(description),
          .default_value = std::move(options.default_value),
          .need = options.need,
          .aliases = std::move(options.aliases)};
}

/// A field whose resolved value is the member's own.
template <class Request, class Member>
RequestField<Request> bound(Member Request::*member, FieldInfo info) {
  return {std::move(info), [member](Request& request, const Json& value) {
            request.*member = value.get<typename ValueOf<Member>::type>();
          }};
}

template <class Value>
std::vector<std::string> first_of_each(const std::vector<std::pair<std::string, Value>>& pairs) {
  std::vector<std::string> result;
  for (const auto& [first, second] : pairs) result.push_back(first);
  return result;
}

}  // namespace detail

template <class Request, class Member>
RequestField<Request> number(std::string name, Member Request::*member, NumberKind kind,
                             std::string description, FieldOptions options = {}) {
  return detail::bound(
      member, detail::info(std::move(name), std::move(kind), std::move(description), std::move(options)));
}

template <class Request, class Member>
RequestField<Request> integer(std::string name, Member Request::*member, IntegerKind kind,
                              std::string description, FieldOptions options = {}) {
  return detail::bound(member,
                       detail::info(std::move(name), kind, std::move(description), std::move(options)));
}

template <class Request>
RequestField<Request> boolean(std::string name, bool Request::*member, std::string description,
                              FieldOptions options = {}) {
  return detail::bound(
      member, detail::info(std::move(name), BooleanKind{}, std::move(description), std::move(options)));
}

/// `most` elements of a kind: NumberKind for a vector of doubles, TextKind for one of strings.
template <class Request, class Element, class ElementKind>
RequestField<Request> list(std::string name, std::vector<Element> Request::*member, ElementKind kind,
                           std::size_t most, std::string description, FieldOptions options = {}) {
  return detail::bound(member, detail::info(std::move(name), ListKind{std::move(kind), most},
                                            std::move(description), std::move(options)));
}

/// The words of a choice, each with the value that it stands for: {{"stop", OnInvalid::stop}, ...}.
template <class Value>
using Words = std::vector<std::pair<std::string, Value>>;

/// One of some words.
template <class Request, class Member, class Value = typename detail::ValueOf<Member>::type>
RequestField<Request> choice(std::string name, Member Request::*member,
                             std::type_identity_t<Words<Value>> words, std::string description,
                             FieldOptions options = {}) {
  ChoiceKind kind{.options = detail::first_of_each(words)};
  return {
      detail::info(std::move(name), std::move(kind), std::move(description), std::move(options)),
      [member, value_of = std::map<std::string, Value>(words.begin(), words.end())](
          Request& request, const Json& word) { request.*member = value_of.at(word.get<std::string>()); }};
}

/// A set of some words.
template <class Request, class Value>
RequestField<Request> choices(std::string name, std::vector<Value> Request::*member,
                              std::type_identity_t<Words<Value>> words, std::string description,
                              FieldOptions options = {}) {
  ListKind kind{ChoiceKind{.options = detail::first_of_each(words)}, words.size()};
  return {detail::info(std::move(name), std::move(kind), std::move(description), std::move(options)),
          [member, value_of = std::map<std::string, Value>(words.begin(), words.end())](Request& request,
                                                                                        const Json& chosen) {
            for (const Json& word : chosen) (request.*member).push_back(value_of.at(word.get<std::string>()));
          }};
}

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
  return detail::bound(member, detail::info(std::move(name), ParameterValueKind{std::move(parameter)},
                                            std::move(description), std::move(options)));
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
