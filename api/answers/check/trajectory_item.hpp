#pragma once
// Items that expect a motion: {"simulate": {...}, "columns": ["l"]}. The reference is computed at the
// instants that were submitted, and compared within atol + rtol times the column's largest magnitude.

#include <optional>

#include "api/answers/check/grader.hpp"

namespace qdot::api {

[[nodiscard]] std::optional<Grader> read_trajectory_item(const CheckItem& item, const std::string& kind,
                                                         const ExpectationScope& scope, const Place& place,
                                                         Errors& errors);

}  // namespace qdot::api
