#pragma once
// Submitted numbers: 0.96, "55.1deg", "pi/3", [1, -2], "(1, -2)", {"x": 1, "theta": -2}.

#include <span>
#include <string>
#include <vector>

#include "api/answers/check/pointed_values.hpp"
#include "api/answers/check/request.hpp"

namespace qdot::api {

struct SubmittedNumbers {
  std::vector<double> values{};           ///< in the units of those expected
  std::vector<std::string> unreadable{};  ///< why it cannot be read
  std::string wrong_unit{};               ///< it was read, and is something else: a mass for a length
  bool is_none{};                         ///< "none": there is no such number
};

/// Read as the numbers that are expected: a list where these are one, by their names where it is an object.
/// Numbers of a set may be more or fewer.
[[nodiscard]] SubmittedNumbers submitted_numbers(const Json& submitted, const Pointed& expected,
                                                 UnitRule unit);

}  // namespace qdot::api
