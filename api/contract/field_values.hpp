#pragma once
// Reading one value by its kind. What comes out is resolved: numbers in SI, integers as integers, whatever
// road the value came along.

#include <optional>
#include <string>
#include <vector>

#include "api/contract/field.hpp"
#include "api/contract/submission.hpp"
#include "api/http/problem.hpp"

namespace qdot::api {

using Errors = std::vector<FieldError>;

/// The resolved value, or none and at least one error. `name` is the symbol or field that is read.
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
[[nodiscard]] std::optional<Json> read_value(const ListKind&, const std::string& name, const Json& value,
                                             const Place& place, Errors& errors);

/// "> 0 and <= 1"; empty where every number is allowed.
[[nodiscard]] std::string to_text(const Domain& domain);

/// "a, b or c"
[[nodiscard]] std::string enumerated(const std::vector<std::string>& words);

}  // namespace qdot::api
