#include "api/answers/check/formula_system.hpp"

#include <algorithm>

#include "api/contract/units.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/mechanics/dimension_check.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot::api {
namespace {

/// "-1.5": a decimal, exactly.
std::optional<Number> decimal(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  const auto number = Number::written(is_negative ? text.substr(1) : text);
  return number && is_negative ? std::optional(-*number) : number;
}

/// A quantity with a unit as the decimal that it is in SI: "12 cm" is 12/100.
std::optional<Number> decimal_of_quantity(std::string_view text, const std::string& unit) {
  const auto value = parse_quantity(text, unit);
  const auto* real = std::get_if<Real>(&value);
  if (real == nullptr) return std::nullopt;
  std::string digits;
  append_number(digits, real->value);
  const auto number = decimal(digits);
  return number && number->rounded() == *real ? number : std::nullopt;
}

class ParameterReader {
 public:
  ParameterReader(FormulaSystem& formula, Errors& errors) : formula_(formula), errors_(errors) {
    for (const Parameter& parameter : formula.scene().parameters) names_.push_back(parameter.name);
  }

  void read(const Json& parameters, const Place& place) {
    if (!parameters.is_object()) {
      report(errors_, wrong_type(place, "parameters", "an object", parameters));
      return;
    }
    for (const auto& [name, value] : parameters.items()) {
      const auto found = std::ranges::find(names_, name);
      const Place here = place.below(name);
      if (found == names_.end()) {
        FieldError error =
            unknown_name(here, "The system has no parameter " + in_quotes(name) + ".", name, names_);
        error.code = "unknown_field";
        report(errors_, std::move(error));
      } else {
        fix(static_cast<std::size_t>(found - names_.begin()), value, here);
      }
    }
  }

 private:
  void fix(std::size_t i, const Json& given, const Place& place) {
    const std::optional<Expression> value = value_of(given, formula_.scene().parameters[i].unit, place);
    if (!value) return;
    const Expression free = formula_.system.with_fixed(*value);
    if (depends_on(free, formula_.system.symbols().parameters[i])) {
      report(errors_,
             place.error("circular", "The value of " + in_quotes(names_[i]) + " depends on itself."));
    } else {
      formula_.system.fix(i, free);
    }
  }

  std::optional<Expression> value_of(const Json& given, const std::string& unit, const Place& place) {
    if (!given.is_number() && !given.is_string()) {
      report(errors_, wrong_type(place, "parameters", "a number or a text", given));
      return std::nullopt;
    }
    const std::string text = given.is_number() ? place.written(given) : given.get<std::string>();
    if (const auto number = decimal(text)) return formula_.graph().number(*number);
    const ParseResult parsed = parse_all(text, formula_.graph(), names_);
    if (parsed.expression) return parsed.expression;
    if (const auto number = decimal_of_quantity(text, unit)) return formula_.graph().number(*number);
    report(errors_,
           place.error("syntax", "It needs a decimal in SI units, or an expression of the parameters: " +
                                     parsed.errors.front().message + "."));
    return std::nullopt;
  }

  FormulaSystem& formula_;
  Errors& errors_;
  std::vector<std::string> names_;
};

void read_names(const Json& names, Vocabulary& vocabulary, const Place& place, Errors& errors) {
  if (names.is_null()) return;
  if (!names.is_object()) {
    report(errors, wrong_type(place, "names", "an object", names));
    return;
  }
  for (const auto& [word, meaning] : names.items()) {
    const Place here = place.below(word);
    if (!meaning.is_string()) {
      report(errors, wrong_type(here, "names", "the name of a symbol", meaning));
      continue;
    }
    std::string plain;
    try {
      plain = plain_notation(word);
    } catch (const Error& error) {
      report(errors, here.error("syntax", std::string(error.what()) + "."));
      continue;
    }
    std::erase(plain, ' ');
    const std::string& symbol = meaning.get_ref<const std::string&>();
    if (vocabulary.add(plain, symbol)) continue;
    FieldError error =
        unknown_name(here, "The system has no " + in_quotes(symbol) + ".", symbol, vocabulary.names());
    error.code = "unknown_symbol";
    report(errors, std::move(error));
  }
}

std::shared_ptr<const Dynamics> dynamics_of(const Json& system, const ExpectationScope& scope,
                                            const Place& place, Errors& errors) {
  const std::shared_ptr<const Scene> scene = scope.find_system(system, place, errors);
  if (!scene) return nullptr;
  try {
    return scope.models.of(SystemChoice{.scene = scene});
  } catch (const SceneError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics())
      report(errors, place.error(diagnostic.code, diagnostic.place + ": " + diagnostic.message));
    return nullptr;
  }
}

void refuse_other_members(const Json& request, const Place& place, Errors& errors) {
  for (const auto& [name, value] : request.items()) {
    if (name == "system" || name == "parameters") continue;
    FieldError error = place.below(name).error(
        "unknown_field", "Here is no " + in_quotes(name) + ": what is expected holds at every state.");
    error.allowed = {"system", "parameters"};
    report(errors, std::move(error));
  }
}

/// Momenta and multipliers, which submissions may speak of.
std::vector<Expression> further_words(const ExpectedSystem& system) {
  std::vector<Expression> words = system.momenta();
  const std::vector<Expression>& multipliers = system.symbols().multipliers;
  words.insert(words.end(), multipliers.begin(), multipliers.end());
  return words;
}

/// "lambda", or "lambda_1" and so on, unless the scene has symbols of these names.
void add_lambdas(const Symbols& symbols, Vocabulary& vocabulary) {
  const std::vector<Expression>& multipliers = symbols.multipliers;
  for (std::size_t j = 0; j < multipliers.size(); ++j) {
    const std::string& name = std::get<qdot::Symbol>(multipliers[j].node()).name;
    const std::string number = std::to_string(j + 1);
    for (const std::string& word : {"lambda_" + number, "lambda" + number, std::string("lambda")}) {
      const bool is_one_of_many = word == "lambda" && multipliers.size() > 1;
      if (!is_one_of_many && !vocabulary.find(word)) (void)vocabulary.add(word, name);
    }
  }
}

}  // namespace

FormulaSystem::FormulaSystem(std::shared_ptr<const Dynamics> of)
    : dynamics(std::move(of)),
      system(dynamics->model()),
      vocabulary(system.symbols(), further_words(system)),
      notation(notation_of(dynamics->model().scene)) {
  add_lambdas(system.symbols(), vocabulary);
  for (std::size_t i = 0; i < scene().coordinates.size(); ++i) {
    if (scene().coordinates[i].unit == "rad") vocabulary.mark_angle(system.symbols().coordinates.value[i]);
  }
  for (const Expression& p : system.momenta())
    vocabulary.add_rate(p, total_derivative(system.with_momenta(p), vocabulary.rates()));
}

std::shared_ptr<FormulaSystem> read_formula_system(const CheckItem& item, const std::string& kind,
                                                   const ExpectationScope& scope, const Place& item_place,
                                                   Errors& errors) {
  const Json& request = item.expect[kind];
  const Place expect = item_place.below("expect"), place = expect.below(kind);
  if (!request.is_object() || !request.contains("system")) {
    report(errors, place.error("missing", "'system' is missing: the name of a system, or a scene."));
    return nullptr;
  }
  refuse_other_members(request, place, errors);
  const auto dynamics = dynamics_of(request["system"], scope, place.below("system"), errors);
  if (!dynamics) return nullptr;
  const std::size_t mistakes = errors.size();
  auto formula = std::make_shared<FormulaSystem>(dynamics);
  if (request.contains("parameters"))
    ParameterReader(*formula, errors).read(request["parameters"], place.below("parameters"));
  read_names(item.names, formula->vocabulary, item_place.below("names"), errors);
  return errors.size() == mistakes ? formula : nullptr;
}

double formula_tolerance(const CheckItem& item, const Place& place, Errors& errors) {
  if (!item.rule) return 0;
  const RuleRequest& rule = *item.rule;
  const bool is_other = rule.kind != Comparison::relabs || rule.atol || !rule.modulo.is_null() ||
                        rule.any_order || rule.any_scale || rule.unit != UnitRule::optional;
  if (is_other || !rule.rtol) {
    report(errors,
           place.below("rule").error(
               "unused",
               "Formulas and equations have no rule but 'rtol', how far their numbers may be rounded."));
    return 0;
  }
  return *rule.rtol;
}

std::string mistake_of_dimension(const FormulaSystem& system, const Expression& e) {
  if (system.system.has_fixed()) return "";  // a number may stand for a letter
  const Scene& scene = system.scene();
  const Symbols& symbols = system.system.symbols();
  SymbolDimensions dimensions;
  const auto add = [&](const Expression& symbol, const std::string& unit) {
    if (const auto known = parse_unit(unit)) dimensions[symbol.id()] = known->dimension;
  };
  for (std::size_t i = 0; i < scene.parameters.size(); ++i)
    add(symbols.parameters[i], scene.parameters[i].unit);
  for (std::size_t i = 0; i < scene.coordinates.size(); ++i) {
    const std::string& unit = scene.coordinates[i].unit;
    add(symbols.coordinates.value[i], unit);
    add(symbols.coordinates.rate[i], "(" + unit + ")/s");
  }
  return dimension_of(e, dimensions).mistake;
}

Json written(const FormulaSystem& system, const ReadEquation& equation) {
  Json json = Json::object();
  for (const auto& [name, form] : {std::pair{"text", Form::text}, std::pair{"latex", Form::latex}}) {
    json[name] = equation.right ? print_equation(equation.left, *equation.right, form, system.notation)
                                : print(equation.left, form, system.notation);
  }
  return json;
}

Json state_json(const FormulaSystem& system, std::span<const SymbolDomain> symbols,
                std::span<const double> state) {
  Json json = Json::object();
  const std::vector<Expression> momenta = system.system.momenta();
  const auto& inputs = system.system.symbols().inputs;
  const auto contains = [](const auto& all, const Expression& e) {
    return std::ranges::find(all, e) != all.end();
  };
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Expression& symbol = symbols[i].symbol;
    if (contains(momenta, symbol) || contains(inputs.rate, symbol) || contains(inputs.second_rate, symbol))
      continue;
    json[std::get<qdot::Symbol>(symbol.node()).name] = state[i];
  }
  return json;
}

}  // namespace qdot::api
