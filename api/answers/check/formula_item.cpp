#include "api/answers/check/formula_item.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "api/answers/check/diagnosis.hpp"
#include "api/json/documents.hpp"
#include "api/json/text.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/grading/inertia_changes.hpp"
#include "core/grading/same_formula.hpp"

namespace qdot::api {
namespace {

/// What one item expects.
struct FormulaItem {
  std::shared_ptr<FormulaSystem> formula;
  std::string name;  ///< "T"; empty: a formula of the teacher's own
  Expression expected;
  double tolerance{};  ///< of rounded numbers; 0: they are exact
  std::uint64_t seed{};
  bool reveal{};
};

/// What stands before an equals sign, without blanks and signs of LaTeX: "E_kin" of "$E_{kin} =".
std::string bare_letters(std::string_view text) {
  std::string letters;
  std::ranges::copy_if(text, std::back_inserter(letters), [](char c) {
    return std::string_view(" $\\{}\t\n(").find(c) == std::string_view::npos;
  });
  return letters;
}

/// Other names of the energies.
bool is_name_of(std::string_view word, std::string_view name) {
  static const std::map<std::string_view, std::vector<std::string_view>> others{
      {"T", {"K", "KE", "E_k", "E_kin", "Ek", "Ekin", "E_K", "T(q,q')"}},
      {"V", {"U", "PE", "E_p", "E_pot", "Ep", "Epot", "E_P", "V(q)"}},
      {"L", {"mathcalL", "mathscrL", "mathrmL", "T-V", "T-U", "K-U", "K-V"}},
      {"E", {"T+V", "T+U", "K+U"}}};
  if (word == name) return true;
  const auto found = others.find(name);
  return found != others.end() && std::ranges::find(found->second, word) != found->second.end();
}

/// The text behind "T =", "E_kin =" or "L = T - V =", unless the system has a symbol of that name.
std::string_view without_name(std::string_view text, const FormulaItem& item) {
  if (item.name.empty()) return text;
  for (std::size_t equals = text.find('='); equals != std::string_view::npos; equals = text.find('=')) {
    const std::string left = bare_letters(text.substr(0, equals));
    const bool is_own = left != item.name && item.formula->vocabulary.find(left);
    if (is_own || !is_name_of(left, item.name)) return text;
    text.remove_prefix(equals + 1);
  }
  return text;
}

/// The formula in a submission; no more than one, which may be the right side of an equation for its symbol.
std::optional<ReadEquation> single(const FormulaItem& item, ReadSubmission& read, Verdict& verdict) {
  verdict.format_errors = read.errors;
  if (!read.errors.empty()) return std::nullopt;
  if (read.equations.size() != 1) {
    verdict.format_errors.emplace_back("one formula is asked for");
    return std::nullopt;
  }
  ReadEquation& equation = read.equations.front();
  if (!equation.right) return equation;
  const auto own = item.formula->vocabulary.find(item.name);
  if (own && equation.left == *own) return ReadEquation{*equation.right, std::nullopt};
  verdict.format_errors.emplace_back("a formula is asked for, not an equation");
  return std::nullopt;
}

Json counterexample_json(const FormulaItem& item, const Expression& submitted, const State& state) {
  const std::vector<SymbolDomain> symbols = item.formula->system.domains();
  Json json{{"state", state_json(*item.formula, symbols, state)}};
  if (item.formula->system.speaks_of_fixed(submitted)) return json;
  const auto value = value_at(item.formula->system, submitted, state);
  if (value) json["value"] = *value;
  return json;
}

Compared compared(const FormulaItem& item, const Expression& submitted) {
  const Model& model = item.formula->dynamics->model();
  return {.submitted = submitted,
          .expected = item.expected,
          .inertia = inertia_changes(model, item.formula->system, item.name)};
}

/// What the submission says of momenta, in velocities, unless the expected formula is one of momenta.
Expression in_velocities(const FormulaItem& item, const Expression& submitted) {
  const ExpectedSystem& system = item.formula->system;
  const bool is_of_momenta = depends_on(item.expected, system.momenta());
  return is_of_momenta ? submitted : system.with_momenta(submitted);
}

/// Whether an acceleration or a momentum is given by itself.
bool speaks_of_itself(const FormulaItem& item, const Expression& submitted) {
  const ExpectedSystem& system = item.formula->system;
  std::vector<Expression> asked = system.momenta();
  const std::vector<Expression>& accelerations = system.symbols().coordinates.second_rate;
  asked.insert(asked.end(), accelerations.begin(), accelerations.end());
  return std::ranges::any_of(asked, [&](const Expression& symbol) {
    return std::get<qdot::Symbol>(symbol.node()).name == item.name && depends_on(submitted, symbol);
  });
}

/// No verdict where the terms of a submission do not add up; whether that is so.
bool refuse_dimension(const FormulaItem& item, const Expression& submitted, Verdict& verdict) {
  const std::string mistake = mistake_of_dimension(*item.formula, submitted);
  if (mistake.empty()) return false;
  verdict.correct.reset();
  verdict.decided_by.clear();
  verdict.format_errors.push_back("its terms are of different dimensions: " + mistake);
  return true;
}

/// A number that is added to an energy has no dimension, whichever energy it is.
bool adds_a_number(const FormulaItem& item, const Expression& formula) {
  constexpr std::array<std::string_view, 5> energies{"V", "L", "E", "h", "H"};
  return std::ranges::find(energies, item.name) != energies.end() &&
         simplify(formula - item.expected).number() != nullptr;
}

void decide(const FormulaItem& item, const Expression& submitted, Verdict& verdict) {
  const ExpectedSystem& system = item.formula->system;
  const Expression formula = system.with_fixed(submitted);
  const FormulaVerdict found =
      compare_formulas(system, item.name, formula, item.expected, item.seed, item.tolerance);
  switch (found.decision) {
    case Decision::identity:
      verdict.correct = true;
      verdict.decided_by = "identity";
      break;
    case Decision::values:
      verdict.correct = true;
      verdict.decided_by = "values";
      break;
    case Decision::rounded:
      verdict.correct = true;
      verdict.decided_by = "rule";
      break;
    case Decision::counterexample:
      if (adds_a_number(item, formula) && refuse_dimension(item, submitted, verdict)) return;
      verdict.correct = false;
      verdict.decided_by = "counterexample";
      verdict.counterexample = counterexample_json(item, submitted, found.counterexample);
      verdict.diagnosis = diagnosis_json(*item.formula, compared(item, submitted), item.seed, item.reveal);
      break;
    case Decision::unknown:
      verdict.feedback.emplace_back(
          "It has a value at too few states, or in too small a part of them, to be compared.");
      break;
  }
  if (!found.differs_by_constant) return;
  if (!refuse_dimension(item, submitted, verdict))
    verdict.feedback.emplace_back("It has another zero of the potential energy, which is free.");
}

Verdict grade_formula(const FormulaItem& item, const Json& submitted) {
  if (!submitted.is_string() && !submitted.is_number()) return unreadable("Write the formula as a text.");
  const std::string text = submitted.is_string() ? submitted.get<std::string>() : dump_json(submitted);
  ReadSubmission read =
      read_submission(without_name(text, item), item.formula->graph(), item.formula->vocabulary);
  Verdict verdict;
  const auto formula = single(item, read, verdict);
  if (!formula) return verdict;
  verdict.understood = written(*item.formula, *formula);
  verdict.expected = written(*item.formula, {item.expected, std::nullopt});
  if (speaks_of_itself(item, formula->left)) {
    verdict.format_errors.push_back("it has " + item.name + " in it, which it is to give");
    return verdict;
  }
  decide(item, in_velocities(item, formula->left), verdict);
  return verdict;
}

std::optional<Expression> named_quantity(const FormulaSystem& formula, const Json& of, const Place& place,
                                         Errors& errors) {
  if (!of.is_string()) {
    report(errors, wrong_type(place, "of", "the name of a formula, such as \"T\"", of));
    return std::nullopt;
  }
  const auto& name = of.get_ref<const std::string&>();
  if (formula.system.is_ambiguous(name)) {
    report(errors, place.error("ambiguous", in_quotes(name) +
                                                " is a name of this scene's own and that of an energy or a "
                                                "momentum: write the formula that is meant as 'is'."));
    return std::nullopt;
  }
  try {
    if (const auto found = formula.system.quantity(name)) return found;
  } catch (const Error& error) {
    report(errors, place.error("not_applicable", error.what()));
    return std::nullopt;
  }
  FieldError error = unknown_name(place, "There is no formula " + in_quotes(name) + ".", name,
                                  formula.system.quantity_names());
  error.code = "unknown_quantity";
  report(errors, std::move(error));
  return std::nullopt;
}

std::optional<Expression> own_formula(FormulaSystem& formula, const Json& is, const Place& place,
                                      Errors& errors) {
  if (!is.is_string()) {
    report(errors, wrong_type(place, "is", "a formula in text", is));
    return std::nullopt;
  }
  const ReadSubmission read =
      read_submission(is.get_ref<const std::string&>(), formula.graph(), formula.vocabulary);
  if (read.equations.size() == 1 && !read.equations[0].right)
    return formula.system.with_fixed(read.equations[0].left);
  const std::string why = read.errors.empty() ? "one formula is needed" : read.errors.front();
  report(errors, place.error("syntax", "It cannot be read: " + why + "."));
  return std::nullopt;
}

}  // namespace

std::optional<Grader> read_formula_item(const CheckItem& item, const std::string& kind,
                                        const ExpectationScope& scope, const Place& place, Errors& errors) {
  const Place expect = place.below("expect");
  auto formula = read_formula_system(item, kind, scope, place, errors);
  if (!formula) return std::nullopt;
  const bool has_name = item.expect.contains("of");
  if (has_name == item.expect.contains("is")) {
    report(errors, expect.error("missing",
                                "'expect' needs 'of', the name of a formula such as \"T\", or 'is', a "
                                "formula of your own."));
    return std::nullopt;
  }
  const auto expected = has_name ? named_quantity(*formula, item.expect["of"], expect.below("of"), errors)
                                 : own_formula(*formula, item.expect["is"], expect.below("is"), errors);
  if (!expected) return std::nullopt;
  FormulaItem read{.formula = std::move(formula),
                   .name = {},
                   .expected = *expected,
                   .tolerance = formula_tolerance(item, place, errors),
                   .seed = scope.seed,
                   .reveal = scope.reveal};
  if (has_name) read.name = item.expect["of"].get<std::string>();
  return [read = std::move(read)](const Json& submitted) { return grade_formula(read, submitted); };
}

}  // namespace qdot::api
