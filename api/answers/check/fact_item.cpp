#include "api/answers/check/fact_item.hpp"

#include <algorithm>
#include <map>

#include "api/answers/check/spoken_words.hpp"
#include "api/contract/domain_text.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

/// What people say and what a box on a form says.
std::optional<bool> truth_of(const Json& submitted) {
  if (submitted.is_boolean()) return submitted.get<bool>();
  if (!submitted.is_string()) return std::nullopt;
  static const std::map<std::string, bool, std::less<>> words{{"yes", true}, {"true", true},   {"y", true},
                                                              {"no", false}, {"false", false}, {"n", false}};
  const auto found = words.find(as_words(submitted.get_ref<const std::string&>()));
  return found == words.end() ? std::nullopt : std::optional(found->second);
}

/// Whether a number lies in a domain; none where its error does not tell.
std::optional<bool> lies_in(const Domain& domain, const PointedValue& value) {
  const auto [middle, error] = value.number();
  const bool at_lower = domain.contains(middle - error), at_upper = domain.contains(middle + error);
  if (at_lower != at_upper) return std::nullopt;
  return at_lower;
}

bool is_same(const Json& value, const Json& is) {
  if (value.is_string() && is.is_string())
    return as_words(value.get_ref<const std::string&>()) == as_words(is.get_ref<const std::string&>());
  return value == is;
}

std::optional<bool> fact(const Pointed& expected, const Json& is) {
  const std::optional<Domain> domain = is.is_string() ? parse_domain(is.get<std::string>()) : std::nullopt;
  if (!domain) {
    return std::ranges::any_of(expected.values, [&](const auto& v) { return is_same(v.value, is); });
  }
  for (const PointedValue& value : expected.values) {
    if (!value.value.is_number()) return std::nullopt;
    const auto one = lies_in(*domain, value);
    if (!one || !*one) return one;
  }
  return true;
}

Verdict grade_truth(bool expected, const Json& submitted) {
  const auto truth = truth_of(submitted);
  if (!truth) return unreadable("Answer yes or no.");
  Verdict verdict{.correct = *truth == expected, .decided_by = "fact", .understood = {{"value", *truth}}};
  verdict.expected = expected;
  return verdict;
}

/// One word of a few, or a word of which no others are known.
Verdict grade_word(const Json& value, const std::string& submitted) {
  const std::string expected = as_words(value.get_ref<const std::string&>());
  const auto choices = choices_with(expected);
  const auto choice = spoken_choice(submitted, choices);
  const std::string word = choice ? std::string(*choice) : as_words(submitted);
  if (word.empty()) return unreadable("Answer with a word.");
  if (!choice && !choices.empty())
    return unreadable("Answer with one word: " + enumerated({choices.begin(), choices.end()}) + ".");
  Verdict verdict{
      .correct = word == expected, .decided_by = "fact", .understood = {{"value", printable(word)}}};
  verdict.expected = value;
  return verdict;
}

}  // namespace

Verdict grade_fact(const Pointed& expected, const Json& is, const Json& submitted) {
  if (!is.is_null()) {
    const auto truth = fact(expected, is);
    return truth ? grade_truth(*truth, submitted)
                 : undecided("What is asked is not known well enough to tell.");
  }
  const Json& value = expected.values.front().value;
  if (value.is_boolean()) return grade_truth(value.get<bool>(), submitted);
  if (!submitted.is_string()) return unreadable("Answer with a word.");
  return grade_word(value, submitted.get_ref<const std::string&>());
}

}  // namespace qdot::api
