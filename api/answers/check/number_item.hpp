#pragma once
// Items that expect what another endpoint answers: numbers, or facts.

#include "api/answers/asking.hpp"
#include "api/answers/check/pointed_values.hpp"
#include "api/answers/check/request.hpp"
#include "api/answers/check/verdict.hpp"

namespace qdot::api {

/// {"turning_points": {...}, "at": "/theta_max"}, answered. With `is` the question is whether the value there
/// is that word or lies in that domain, "> 0".
struct AnswerItem {
  Pointed expected;
  Json is;  ///< null: the value itself
  NumberRule rule;
  Grouping grouping;
  UnitRule unit{UnitRule::optional};
};

/// None after errors were reported.
[[nodiscard]] std::optional<AnswerItem> read_answer_item(const CheckItem& item, const std::string& question,
                                                         AskedOnce& asking, const Place& place,
                                                         Errors& errors);

/// Reads what was submitted by the item's rules for numbers, units and lists, and compares it with what is
/// expected, within the tolerance of the rule (core/grading/number_rule.hpp). Undecided where the error of
/// the expected number leaves both open.
[[nodiscard]] Verdict grade(const AnswerItem& item, const Json& submitted);

}  // namespace qdot::api
