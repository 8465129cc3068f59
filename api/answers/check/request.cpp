#include "api/answers/check/request.hpp"

#include <set>

#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

const Domain not_negative{.lower = 0};
const Domain of_points{.lower = 0, .upper = 1e9};

/// Fields that belong to one kind of rule, or to several.
struct RuleOption {
  std::string_view field;
  std::vector<Comparison> kinds;
  bool (*is_given)(const RuleRequest&);
};

const std::vector<RuleOption>& rule_options() {
  using enum Comparison;
  static const std::vector<RuleOption> all{
      {"rtol", {relabs}, [](const RuleRequest& r) { return r.rtol.has_value(); }},
      {"atol", {relabs}, [](const RuleRequest& r) { return r.atol.has_value(); }},
      {"digits", {sigfig, decdig}, [](const RuleRequest& r) { return r.digits.has_value(); }},
      {"testoptions",
       {stack_relative, stack_absolute},
       [](const RuleRequest& r) { return r.testoptions.has_value(); }},
      {"tolerance", {webwork}, [](const RuleRequest& r) { return r.tolerance.has_value(); }},
      {"tolType", {webwork}, [](const RuleRequest& r) { return r.tol_type.has_value(); }},
      {"zeroLevel", {webwork}, [](const RuleRequest& r) { return r.zero_level.has_value(); }},
      {"zeroLevelTol", {webwork}, [](const RuleRequest& r) { return r.zero_tolerance.has_value(); }}};
  return all;
}

const Table<RuleRequest>& rule_table() {
  using enum Comparison;
  static const NumberKind tolerance{"1", not_negative};
  static const Table<RuleRequest> table(
      "rule", "How numbers are compared; each kind has its own system's options and defaults.",
      {
          choice("kind", &RuleRequest::kind,
                 {{"relabs", relabs},
                  {"sigfig", sigfig},
                  {"decdig", decdig},
                  {"stack_relative", stack_relative},
                  {"stack_absolute", stack_absolute},
                  {"webwork", webwork}},
                 "PrairieLearn's relabs, sigfig, decdig; STACK's NumRelative, NumAbsolute; WeBWorK's reals",
                 {.default_value = "relabs", .aliases = {"comparison", "type"}}),
          number(
              "rtol", &RuleRequest::rtol, tolerance,
              "relabs: relative tolerance, 0.01 by default; of a formula or an equation: how far its numbers may be "
              "rounded, 0 by default"),
          number("atol", &RuleRequest::atol, tolerance, "relabs: absolute tolerance, 1e-8 by default"),
          integer("digits", &RuleRequest::digits, {1, 17}, "sigfig, decdig: digits that count, 2 by default"),
          number("testoptions", &RuleRequest::testoptions, tolerance,
                 "stack_relative, stack_absolute: tolerance, 0.05 by default"),
          number("tolerance", &RuleRequest::tolerance, tolerance, "webwork: tolerance, 0.001 by default"),
          choice<RuleRequest, std::optional<std::string>>(
              "tolType", &RuleRequest::tol_type, {{"relative", "relative"}, {"absolute", "absolute"}},
              "webwork: relative by default"),
          number("zeroLevel", &RuleRequest::zero_level, tolerance, "webwork: 1e-14 by default"),
          number("zeroLevelTol", &RuleRequest::zero_tolerance, tolerance, "webwork: 1e-12 by default"),
          value("modulo", &RuleRequest::modulo, AnyKind{{{"type", {"number", "string"}}}},
                "numbers agree modulo this: \"2pi\" or \"2*pi\" for angles"),
          boolean("any_order", &RuleRequest::any_order, "the numbers are a set", {.default_value = false}),
          boolean("any_scale", &RuleRequest::any_scale, "the numbers are a direction, such as a mode shape",
                  {.default_value = false}),
          choice("unit", &RuleRequest::unit,
                 {{"optional", UnitRule::optional}, {"required", UnitRule::required}},
                 "whether a submitted number has to have its unit", {.default_value = "optional"}),
      });
  return table;
}

const Table<CheckItem>& item_table() {
  static const Table<CheckItem> table(
      "check_item", "One question with what was submitted.",
      {
          value("id", &CheckItem::id, TextKind{limits::name_bytes},
                "what the result calls it; its number, from 1, where there is none"),
          number("points", &CheckItem::points, {"1", of_points}, "what a right answer earns",
                 {.default_value = 1.0}),
          value("expect", &CheckItem::expect, AnyKind{{{"type", "object"}}},
                "an endpoint's name with a whole request of it, and 'at': pointers into its answer",
                required),
          value("submitted", &CheckItem::submitted, AnyKind{},
                "what was handed in: a number, a text, or an array or object of them; none: no answer",
                {.aliases = {"answer", "response", "submission", "value"}}),
          record("rule", &CheckItem::rule, rule_table(), "how numbers are compared"),
          value("names", &CheckItem::names,
                AnyKind{{{"type", "object"}, {"additionalProperties", {{"type", "string"}}}}},
                "the submission's own words for symbols: {\"w\": \"Omega\"}"),
      });
  return table;
}

void check_rule(const CheckItem& item, const Place& place, Findings& findings) {
  if (!item.rule) return;
  const Place rule = place.below("rule");
  for (const RuleOption& option : rule_options()) {
    const bool belongs = std::ranges::find(option.kinds, item.rule->kind) != option.kinds.end();
    if (belongs || !option.is_given(*item.rule)) continue;
    findings.add(rule.below(option.field)
                     .error("unused", "This kind of rule has no '" + std::string(option.field) + "'."));
  }
}

void check_items(CheckRequest& request, Findings& findings) {
  std::set<std::string> ids;
  const Place items = findings.root().below("items");
  for (std::size_t i = 0; i < request.items.size(); ++i) {
    const Place place = items.below(i);
    const CheckItem& item = request.items[i];
    check_rule(item, place, findings);
    if (item.id.empty()) request.items[i].id = std::to_string(i + 1);
    if (!ids.insert(item.id).second)
      findings.add(place.below("id").error("duplicate_name", "Two items have this id."));
  }
}

}  // namespace

const RequestTable<CheckRequest>& check_table() {
  static const RequestTable<CheckRequest> table(
      {
          records("items", &CheckRequest::items, item_table(), 1, limits::check_items,
                  "questions with what was submitted", required),
          integer("seed", &CheckRequest::seed, {0, 9'007'199'254'740'991},
                  "chooses the states at which expressions are compared", {.default_value = 0}),
          boolean("reveal", &CheckRequest::reveal,
                  "whether the answer may say what was expected; otherwise nothing of it leaves",
                  {.default_value = false, .aliases = {"show_answer"}}),
          choice("format", &CheckRequest::format,
                 {{"json", GradeFormat::json},
                  {"gradescope", GradeFormat::gradescope},
                  {"prairielearn", GradeFormat::prairielearn},
                  {"coderunner", GradeFormat::coderunner}},
                 "the result as the file that this grader reads", {.default_value = "json"}),
      },
      {}, check_items);
  return table;
}

}  // namespace qdot::api
