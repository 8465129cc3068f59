#pragma once
// Items that expect equations of motion: {"equation": {"system": ...}, "of": "theta"}, or all of them.

#include "api/answers/check/formula_system.hpp"

namespace qdot::api {

[[nodiscard]] std::optional<Grader> read_equation_item(const CheckItem& item, const std::string& kind,
                                                       const ExpectationScope& scope, const Place& place,
                                                       Errors& errors);

}  // namespace qdot::api
