#pragma once
// Values in an answer by JSON Pointer (RFC 6901), each with its unit and with the error that the answer
// states for it. A * in a pointer stands for every element of an array.

#include <optional>
#include <string>
#include <vector>

#include "api/contract/field_values.hpp"
#include "api/json/json.hpp"
#include "core/grading/number_rule.hpp"

namespace qdot::api {

/// A number, text, truth value or null in an answer.
struct PointedValue {
  std::string name;  ///< its key, or that of the array that it stands in
  Json value;
  std::string unit;  ///< as the answer's `units` have it; "1" where they do not speak of it
  double error{};    ///< of a number

  [[nodiscard]] KnownNumber number() const { return {value.get<double>(), error}; }
};

/// What a pointer leads to: one value, or those in an array or object, in their order.
struct Pointed {
  bool is_list{};
  std::vector<PointedValue> values;
};

/// None after an error was reported, when the pointer leads nowhere.
[[nodiscard]] std::optional<Pointed> pointed(const Json& answer, const std::string& pointer,
                                             const Place& place, Errors& errors);

}  // namespace qdot::api
