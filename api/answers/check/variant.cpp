#include "api/answers/check/variant.hpp"

#include <algorithm>
#include <vector>

#include "api/answers/check/answer_sheet.hpp"
#include "api/answers/check/expectation.hpp"
#include "api/answers/check/number_item.hpp"
#include "api/answers/check/ranges.hpp"
#include "api/answers/questions.hpp"
#include "api/json/documents.hpp"
#include "api/json/limits.hpp"
#include "api/json/writer.hpp"
#include "core/grading/number_slip.hpp"
#include "core/numerics/random_bits.hpp"

namespace qdot::api {
namespace {

constexpr int most_draws = 200;

Json numbers_of(const Pointed& expected, const std::vector<double>& values) {
  return expected.is_list ? Json(values) : Json(values.front());
}

/// Each wrong answer that one slip gives in place of all expected numbers. A set counts as its
/// mirror image, and a direction as its multiples.
std::vector<Json> usual_wrong_answers(const AnswerItem& item) {
  std::vector<std::vector<std::pair<NumberSlip, double>>> slips;
  std::size_t count = item.grouping.any_scale ? 0 : 100;
  for (const PointedValue& value : item.expected.values) {
    slips.push_back(slips_of(value.value.get<double>(), value.unit));
    if (!slips.back().empty()) count = std::min(count, slips.back().size());
  }
  std::vector<Json> wrong;
  for (std::size_t kind = 0; kind < count; ++kind) {
    std::vector<double> values;
    bool is_mirrored = false;
    for (const auto& of_value : slips) {
      values.push_back(of_value.empty() ? 0.0 : of_value[kind].second);
      is_mirrored = is_mirrored || (!of_value.empty() && of_value[kind].first == NumberSlip::sign);
    }
    if (!(is_mirrored && item.grouping.any_order)) wrong.push_back(numbers_of(item.expected, values));
  }
  return wrong;
}

/// Why an item's numbers cannot be graded; empty where they can.
std::string why_not_graded(const AnswerItem& item) {
  std::vector<double> right;
  for (const PointedValue& value : item.expected.values) {
    if (!value.value.is_number()) return "it has no number";
    right.push_back(value.value.get<double>());
  }
  if (right.empty()) return "there are no numbers";
  if (std::ranges::all_of(right, [](double x) { return x == 0; }))
    return "a wrong factor would not be seen of zero";
  if (grade(item, numbers_of(item.expected, right)).correct != true)
    return "its number is not known well enough";
  for (const Json& wrong : usual_wrong_answers(item)) {
    if (grade(item, wrong).correct != false)
      return "a usual slip, " + dump_json(wrong) + ", would count as right";
  }
  return "";
}

bool expects_numbers(const AnswerItem& item) {
  return item.is.is_null() && std::ranges::none_of(item.expected.values, [](const PointedValue& value) {
           return value.value.is_string() || value.value.is_boolean();
         });
}

std::string first_of(const Errors& errors) {
  return errors.empty() ? "it cannot be asked" : errors.front().pointer + ": " + errors.front().detail;
}

/// Why one item is not gradable, or too easily right; empty where it is neither.
std::string why_degenerate(const CheckItem& item, const ExpectationScope& scope, const Place& place) {
  Errors errors;
  const auto names = scope.asking.names();
  const auto question =
      std::ranges::find_if(names, [&](const auto& name) { return item.expect.contains(name); });
  if (question == names.end() || !item.expect.contains("at")) {
    const bool is_read = read_expectation(item, scope, place, errors).has_value();
    return is_read && errors.empty() ? "" : first_of(errors);
  }
  const auto answer = read_answer_item(item, *question, scope.once, place, errors);
  if (!answer || !errors.empty()) return first_of(errors);
  return expects_numbers(*answer) ? why_not_graded(*answer) : "";
}

/// As why_degenerate; what core throws is a reason, too.
std::string why_item_refused(const CheckItem& item, const ExpectationScope& scope, const Place& place) {
  try {
    return why_degenerate(item, scope, place);
  } catch (const Error& error) {
    return problem_of(error, place).detail;
  }
}

/// Why a request is no good variant; empty where it is one.
std::string why_refused(const Json& request, const Asking& asking, const FindSystem& find_system,
                        Models& models) {
  const auto submission = submission_of_body(
      to_text(request), {.bytes = limits::large_body_bytes, .nodes = limits::large_json_nodes});
  if (const auto* problem = std::get_if<Problem>(&submission)) return problem->detail;
  const auto read = check_table().read(std::get<Submission>(submission), find_system);
  if (const auto* problem = std::get_if<Problem>(&read))
    return problem->errors.empty() ? problem->detail : first_of(problem->errors);
  const CheckRequest& check = std::get<Resolved<CheckRequest>>(read).request;
  KeptAnswers kept;
  AskedOnce once(asking, kept);
  const ExpectationScope scope{asking,      once, find_system, models, static_cast<std::uint64_t>(check.seed),
                               check.reveal};
  const Place whole(Road::body);
  const Place items = whole.below("items");
  for (std::size_t i = 0; i < check.items.size(); ++i) {
    const std::string why = why_item_refused(check.items[i], scope, items.below(i));
    if (!why.empty()) return "of the item " + check.items[i].id + ", " + why;
  }
  return "";
}

Choice drawn_choice(const std::vector<KeyRange>& ranges, RandomBits& bits) {
  Choice choice;
  for (const KeyRange& range : ranges) choice[range.name] = range.values[bits() % range.values.size()];
  return choice;
}

Json variant_json(std::uint64_t seed, const std::vector<KeyRange>& ranges, const Choice& choice,
                  const Json& request) {
  Json values = Json::object();
  for (const KeyRange& range : ranges) values[range.name] = with_unit(choice.at(range.name), range);
  Json result{{"variant", {{"seed", seed}, {"values", std::move(values)}}}};
  for (const auto& [name, value] : request.items()) result[name] = value;
  return result;
}

}  // namespace

std::variant<Json, SheetError> drawn_variant(std::string_view key, std::uint64_t seed,
                                             const FindSystem& find_system, Models& models) {
  const auto sheet = sheet_object(key, "the key", limits::large_body_bytes);
  if (const auto* error = std::get_if<SheetError>(&sheet)) return *error;
  const auto read = ranges_of(std::get<Json>(sheet));
  if (const auto* error = std::get_if<SheetError>(&read)) return *error;
  const auto& ranges = std::get<std::vector<KeyRange>>(read);
  if (ranges.empty()) return SheetError{"the key has no 'ranges' to draw from"};
  const Asking asking(questions(), find_system, models);
  RandomBits bits(seed);
  std::string why;
  for (int draw = 0; draw < most_draws; ++draw) {
    const Choice choice = drawn_choice(ranges, bits);
    const auto request = with_values(std::get<Json>(sheet), ranges, choice);
    if (const auto* error = std::get_if<SheetError>(&request)) return *error;
    why = why_refused(std::get<Json>(request), asking, find_system, models);
    if (why.empty()) return variant_json(seed, ranges, choice, std::get<Json>(request));
  }
  return SheetError{"no draw of " + std::to_string(most_draws) +
                    " gives a variant that can be graded; the last: " + why};
}

}  // namespace qdot::api
