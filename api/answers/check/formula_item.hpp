#pragma once
// Items that expect a formula: {"expression": {"system": ...}, "of": "T"}, or "is": a formula of one's own.

#include "api/answers/check/formula_system.hpp"

namespace qdot::api {

[[nodiscard]] std::optional<Grader> read_formula_item(const CheckItem& item, const std::string& kind,
                                                      const ExpectationScope& scope, const Place& place,
                                                      Errors& errors);

}  // namespace qdot::api
