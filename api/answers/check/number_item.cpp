#include "api/answers/check/number_item.hpp"

#include <algorithm>
#include <cmath>

#include "api/answers/check/fact_item.hpp"
#include "api/answers/check/submitted_numbers.hpp"
#include "api/contract/written_value.hpp"
#include "api/json/text.hpp"
#include "core/grading/number_slip.hpp"
#include "core/numerics/constants.hpp"

namespace qdot::api {
namespace {

NumberRule number_rule(const RuleRequest& request) {
  NumberRule rule{.comparison = request.kind};
  const bool is_webwork = request.kind == Comparison::webwork;
  rule.rtol = request.rtol.value_or(rule.rtol);
  rule.atol = request.atol.value_or(rule.atol);
  rule.digits = static_cast<int>(request.digits.value_or(rule.digits));
  rule.tolerance = is_webwork ? request.tolerance.value_or(1e-3) : request.testoptions.value_or(0.05);
  rule.zero_level = request.zero_level.value_or(rule.zero_level);
  rule.zero_tolerance = request.zero_tolerance.value_or(rule.zero_tolerance);
  rule.is_relative = request.tol_type != "absolute";
  return rule;
}

/// "2pi" is how people write 2*pi.
std::optional<double> period_of(const Json& modulo, const Place& place, Errors& errors) {
  if (modulo.is_null()) return std::nullopt;
  std::string text = modulo.is_string() ? modulo.get<std::string>() : place.written(modulo);
  const std::size_t pi_at = text.find("pi");
  if (pi_at != std::string::npos && pi_at > 0 && std::isdigit(static_cast<unsigned char>(text[pi_at - 1])))
    text.insert(pi_at, "*");
  ParameterScope numbers_only;
  const auto value = written_value(text, "rad", numbers_only);
  if (const auto* period = std::get_if<Real>(&value); period != nullptr && period->value > 0) {
    return period->value;
  }
  report(errors, place.error("syntax", "'modulo' needs a positive number, such as \"2pi\"."));
  return std::nullopt;
}

/// The values at one pointer, or at each of a list.
std::optional<Pointed> values_at(const Json& answer, const Json& at, const Place& place, Errors& errors) {
  if (at.is_string()) return pointed(answer, at.get<std::string>(), place, errors);
  if (!at.is_array() || at.empty()) {
    report(errors,
           place.error("wrong_type", "'at' needs a JSON Pointer into the answer, or a list of them."));
    return std::nullopt;
  }
  Pointed all{.is_list = true, .values = {}};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Place here = place.below(i);
    if (!at[i].is_string()) {
      report(errors, wrong_type(here, "at", "a JSON Pointer", at[i]));
      return std::nullopt;
    }
    auto one = pointed(answer, at[i].get<std::string>(), here, errors);
    if (!one) return std::nullopt;
    std::ranges::move(one->values, std::back_inserter(all.values));
  }
  return all;
}

/// Numbers are compared with numbers; anything else stands alone.
bool can_be_graded(const AnswerItem& item) {
  const auto is_number = [](const PointedValue& v) { return v.value.is_number(); };
  if (!item.is.is_null()) return true;
  return std::ranges::all_of(item.expected.values, is_number) || !item.expected.is_list;
}

Json numbers_json(std::span<const double> values, bool is_list) {
  return is_list ? Json(std::vector<double>(values.begin(), values.end())) : Json(values.front());
}

Json expected_json(const Pointed& expected) {
  Json list = Json::array();
  for (const PointedValue& value : expected.values) list.push_back(value.value);
  return expected.is_list ? list : list.front();
}

Json understood_json(const AnswerItem& item, const SubmittedNumbers& numbers) {
  if (numbers.is_none) return {{"value", nullptr}};
  Json understood{{"value", numbers_json(numbers.values, item.expected.is_list)}};
  if (!item.expected.is_list) understood["unit"] = item.expected.values.front().unit;
  return understood;
}

Json number_diagnosis(const AnswerItem& item, double submitted) {
  const PointedValue& expected = item.expected.values.front();
  const auto found = find_number_slip(submitted, expected.value.get<double>(), expected.unit);
  if (!found) return nullptr;
  static constexpr const char* sentences[]{"The sign is wrong.",
                                           "It is in degrees; a number without a unit is in radians.",
                                           "It is in radians; degrees are asked for.",
                                           "It is the period.",
                                           "It is the angular frequency.",
                                           "It is the frequency in turns.",
                                           "A simple factor is missing, or too much.",
                                           "A square or a root is missing, or too much."};
  return {{"slip", name_of(*found)}, {"text", sentences[static_cast<std::size_t>(*found)]}};
}

Verdict grade_numbers(const AnswerItem& item, const SubmittedNumbers& numbers) {
  Verdict verdict{.correct = {}, .decided_by = "rule", .understood = understood_json(item, numbers)};
  verdict.expected = expected_json(item.expected);
  const bool is_nothing = item.expected.values.size() == 1 && item.expected.values[0].value.is_null();
  if (is_nothing || (numbers.is_none && !item.expected.values.empty())) {
    verdict.correct = is_nothing && numbers.is_none;
    return verdict;
  }
  std::vector<KnownNumber> expected;
  for (const PointedValue& value : item.expected.values) expected.push_back(value.number());
  if (numbers.values.size() != expected.size() && !item.grouping.any_order) {
    return unreadable(std::to_string(expected.size()) + " numbers are asked for; here are " +
                      std::to_string(numbers.values.size()) + ".");
  }
  const Agreement agreement = compare(item.rule, item.grouping, numbers.values, expected);
  if (agreement == Agreement::unknown) {
    verdict.feedback.push_back("The expected number is not known well enough to tell.");
  } else {
    verdict.correct = agreement == Agreement::yes;
    const bool is_single = !item.expected.is_list && agreement == Agreement::no;
    if (is_single) verdict.diagnosis = number_diagnosis(item, numbers.values.front());
  }
  return verdict;
}

}  // namespace

std::optional<AnswerItem> read_answer_item(const CheckItem& item, const std::string& question,
                                           AskedOnce& asking, const Place& place, Errors& errors) {
  const Place expect = place.below("expect");
  const auto answer = asking.ask(question, item.expect[question], expect.below(question), errors);
  AnswerItem result;
  const RuleRequest rule = item.rule.value_or(RuleRequest{});
  const Place modulo_place = place.below("rule");
  result.grouping = {.any_order = rule.any_order,
                     .any_scale = rule.any_scale,
                     .period = period_of(rule.modulo, modulo_place.below("modulo"), errors)};
  if (!answer) return std::nullopt;
  if (!item.expect.contains("at")) {
    report(errors, expect.error("missing",
                                "'at' is missing: a pointer to the expected number, such as "
                                "\"/theta_max\"."));
    return std::nullopt;
  }
  auto expected = values_at(*answer, item.expect["at"], expect.below("at"), errors);
  if (!expected) return std::nullopt;
  result.expected = std::move(*expected);
  result.is = item.expect.value("is", Json());
  result.rule = number_rule(rule);
  result.unit = rule.unit;
  if (result.grouping.period && !result.expected.values.empty() && result.expected.values[0].unit == "deg")
    *result.grouping.period *= 180 / pi;
  if (can_be_graded(result)) return result;
  report(errors, expect.below("at").error("wrong_type", "There are not only numbers there."));
  return std::nullopt;
}

Verdict grade(const AnswerItem& item, const Json& submitted) {
  const bool is_fact =
      !item.is.is_null() || (!item.expected.is_list && !item.expected.values[0].value.is_number() &&
                             !item.expected.values[0].value.is_null());
  if (is_fact) return grade_fact(item.expected, item.is, submitted);
  const SubmittedNumbers numbers = submitted_numbers(submitted, item.expected, item.unit);
  if (!numbers.unreadable.empty()) return {.format_errors = numbers.unreadable};
  if (!numbers.wrong_unit.empty() && item.grouping.any_scale)
    return unreadable("Write a direction without units: how its numbers stand to each other in SI.");
  if (!numbers.wrong_unit.empty()) {
    return {.correct = false, .decided_by = "unit", .feedback = {numbers.wrong_unit}};
  }
  return grade_numbers(item, numbers);
}

}  // namespace qdot::api
