#pragma once
// What an item expects. A kind of expectation is added by a reader that makes a grader of it, and its line in
// expectation.cpp.

#include <optional>

#include "api/answers/check/grader.hpp"

namespace qdot::api {

/// None after errors were reported.
[[nodiscard]] std::optional<Grader> read_expectation(const CheckItem& item, const ExpectationScope& scope,
                                                     const Place& place, Errors& errors);

}  // namespace qdot::api
