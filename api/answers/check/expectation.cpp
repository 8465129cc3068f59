#include "api/answers/check/expectation.hpp"

#include <algorithm>

#include "api/answers/check/equation_item.hpp"
#include "api/answers/check/formula_item.hpp"
#include "api/answers/check/number_item.hpp"
#include "api/answers/check/trajectory_item.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

using ExpectationReader = std::optional<Grader> (*)(const CheckItem& item, const std::string& kind,
                                                    const ExpectationScope& scope, const Place& place,
                                                    Errors& errors);

/// A kind of expectation: the member of `expect` that says it, and the members that it has beside.
struct ExpectationKind {
  std::string name;
  std::vector<std::string> beside;
  ExpectationReader read;
};

std::optional<Grader> read_numbers(const CheckItem& item, const std::string& kind,
                                   const ExpectationScope& scope, const Place& place, Errors& errors) {
  if (kind == "simulate" && !item.expect.contains("at"))
    return read_trajectory_item(item, kind, scope, place, errors);
  auto read = read_answer_item(item, kind, scope.once, place, errors);
  if (!read) return std::nullopt;
  return [answer = std::move(*read)](const Json& submitted) { return grade(answer, submitted); };
}

/// Every endpoint's answer has numbers to expect; then the kinds that no endpoint answers.
std::vector<ExpectationKind> expectation_kinds(const Asking& asking) {
  std::vector<ExpectationKind> kinds;
  for (const std::string& name : asking.names()) {
    kinds.push_back({name, {"at", "is"}, read_numbers});
    if (name == "simulate") kinds.back().beside.emplace_back("columns");
  }
  kinds.push_back({"equation", {"of"}, read_equation_item});
  kinds.push_back({"expression", {"of", "is"}, read_formula_item});
  return kinds;
}

std::vector<std::string> names_of(const std::vector<ExpectationKind>& kinds) {
  std::vector<std::string> names;
  for (const ExpectationKind& kind : kinds) names.push_back(kind.name);
  return names;
}

void refuse_others(const Json& expect, const ExpectationKind& kind, const Place& place, Errors& errors) {
  std::vector<std::string> allowed = kind.beside;
  allowed.push_back(kind.name);
  for (const auto& [name, value] : expect.items()) {
    if (std::ranges::find(allowed, name) != allowed.end()) continue;
    FieldError error = unknown_name(
        place.below(name), "'expect' with " + in_quotes(kind.name) + " has no " + in_quotes(name) + ".", name,
        allowed);
    error.code = "unknown_field";
    report(errors, std::move(error));
  }
}

}  // namespace

std::optional<Grader> read_expectation(const CheckItem& item, const ExpectationScope& scope,
                                       const Place& place, Errors& errors) {
  const Place expect = place.below("expect");
  if (!item.expect.is_object()) {
    report(errors, wrong_type(expect, "expect", "an object", item.expect));
    return std::nullopt;
  }
  const std::vector<ExpectationKind> kinds = expectation_kinds(scope.asking);
  const auto kind =
      std::ranges::find_if(kinds, [&](const ExpectationKind& k) { return item.expect.contains(k.name); });
  if (kind == kinds.end()) {
    FieldError error = expect.error("missing", "'expect' needs one of " + enumerated(names_of(kinds)) + ".");
    error.allowed = names_of(kinds);
    report(errors, std::move(error));
    return std::nullopt;
  }
  refuse_others(item.expect, *kind, expect, errors);
  return kind->read(item, kind->name, scope, place, errors);
}

}  // namespace qdot::api
