#pragma once
// Reading one value by its kind. What comes out is resolved: numbers in SI, integers as integers, expressions
// as texts, whichever way the value was sent. Kinds that hold others are read by record_reader.hpp.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "api/contract/field.hpp"
#include "api/contract/submission.hpp"
#include "api/contract/written_value.hpp"
#include "api/http/problem.hpp"
#include "api/json/text.hpp"
#include "core/numerics/real.hpp"

namespace qdot::api {

using Errors = std::vector<FieldError>;

/// Of fields that are numbers or lists of them: the numbers as they were typed, where doubles are others.
using ExactNumbers = std::map<std::string, std::vector<Real>, std::less<>>;

/// Adds the error, unless there are more already than an answer lists.
void report(Errors& errors, FieldError error);

/// Whether another error would not be listed.
[[nodiscard]] bool is_full(const Errors& errors);

/// The error of a name that is none of `allowed`, with the one that was probably meant.
[[nodiscard]] FieldError unknown_name(const Place& place, std::string detail, const std::string& name,
                                      std::vector<std::string> allowed);

/// The error of a value of another type: "'samples' needs a whole number, not a string."
[[nodiscard]] FieldError wrong_type(const Place& place, const std::string& name, const std::string& needed,
                                    const Json& value);

/// A number in SI with what a double leaves out of it, or none after it has reported an error.
/// A text may be an expression of what is in scope.
[[nodiscard]] std::optional<Real> read_number(const NumberKind&, const std::string& name, const Json& value,
                                              const Place& place, ParameterScope& scope, Errors& errors);

// Each returns the resolved value, or none after it has reported at least one error. `name` is the symbol or
// field that is read.

[[nodiscard]] std::optional<Json> read_value(const NumberKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);
[[nodiscard]] std::optional<Json> read_value(const IntegerKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);
[[nodiscard]] std::optional<Json> read_value(const BooleanKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);
[[nodiscard]] std::optional<Json> read_value(const TextKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);
[[nodiscard]] std::optional<Json> read_value(const ChoiceKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);
[[nodiscard]] std::optional<Json> read_value(const SignKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);
[[nodiscard]] std::optional<Json> read_value(const NameKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);
[[nodiscard]] std::optional<Json> read_value(const ExpressionKind&, const std::string& name,
                                             const Json& value, const Place& place, Errors& errors);
[[nodiscard]] std::optional<Json> read_value(const DomainKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);

[[nodiscard]] std::optional<Json> read_value(const AnyKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);

/// "'a b' cannot be a name: ..."
[[nodiscard]] FieldError bad_name(const Place& place, std::string_view name, NameOf of = NameOf::thing);

}  // namespace qdot::api
