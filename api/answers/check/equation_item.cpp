#include "api/answers/check/equation_item.hpp"

#include <algorithm>
#include <array>

#include "api/answers/check/diagnosis.hpp"
#include "api/json/text.hpp"
#include "core/expr/print/print.hpp"
#include "core/grading/definitions.hpp"
#include "core/grading/inertia_changes.hpp"
#include "core/grading/same_motion.hpp"

namespace qdot::api {
namespace {

struct EquationItem {
  std::shared_ptr<FormulaSystem> formula;
  std::optional<std::size_t> coordinate;  ///< none: the equations of all coordinates
  double tolerance{};                     ///< of rounded numbers; 0: they are exact
  std::uint64_t seed{};
  bool reveal{};

  /// How many equations can answer: as many as coordinates; under constraints fewer, where multipliers are
  /// eliminated, or more, where those of the constraints and their derivatives stand beside.
  [[nodiscard]] std::size_t fewest() const {
    return coordinate ? 1 : degrees() - std::min(degrees(), of_constraints());
  }
  [[nodiscard]] std::size_t most() const { return coordinate ? 1 : degrees() + 3 * of_constraints(); }
  [[nodiscard]] std::size_t degrees() const { return formula->system.degrees_of_freedom(); }
  [[nodiscard]] std::size_t of_constraints() const { return formula->scene().constraints.size(); }
};

/// One text with an equation a line, from a text or from an array of them.
std::optional<std::string> text_of_equations(const Json& submitted) {
  if (submitted.is_string()) return submitted.get<std::string>();
  if (!submitted.is_array() || submitted.empty()) return std::nullopt;
  std::string text;
  for (const Json& line : submitted) {
    if (!line.is_string()) return std::nullopt;
    text += line.get_ref<const std::string&>() + "\n;";
  }
  return text;
}

std::string how_many(const EquationItem& item, std::size_t found) {
  std::string asked = item.fewest() == 1
                          ? "one equation is asked for"
                          : std::to_string(item.fewest()) + " equations are asked for, one a line";
  if (item.fewest() != item.most())
    asked =
        std::to_string(item.degrees()) +
        " equations are asked for, one a line, or fewer without multipliers, or more with the constraints";
  return asked + ", and " + std::to_string(found) + (found == 1 ? " is here" : " are here");
}

Json all_written(const FormulaSystem& formula, std::span<const ReadEquation> equations) {
  if (equations.size() == 1) return written(formula, equations.front());
  Json text = Json::array(), latex = Json::array();
  for (const ReadEquation& equation : equations) {
    const Json one = written(formula, equation);
    text.push_back(one["text"]);
    latex.push_back(one["latex"]);
  }
  return {{"text", std::move(text)}, {"latex", std::move(latex)}};
}

/// What to say of an equation that is not the right one.
const char* sentence(MotionFault fault) {
  switch (fault) {
    case MotionFault::none:
      return "";
    case MotionFault::not_true:
      return "The motion does not obey it.";
    case MotionFault::holds_always:
      return "It holds whatever the motion is, so it says nothing about it.";
    case MotionFault::of_constraints:
      return "It is a constraint, or follows from the constraints alone, so it says nothing of what moves the system.";
    case MotionFault::other_coordinate:
      return "It is true, but it is not the equation of this coordinate.";
    case MotionFault::other_solutions:
      return "The motion obeys it, but another acceleration would, too.";
    case MotionFault::dependent:
      return "One of the equations follows from the others.";
    case MotionFault::undetermined:
      return "With the constraints they leave accelerations or multipliers free.";
    case MotionFault::not_linear:
      return "It is not linear in the accelerations, so that it may have other solutions, too: solve it for them.";
    case MotionFault::undecided:
      return "It has a value at too few states, or in too small a part of them, to be compared.";
  }
  return "";
}

bool has_no_verdict(MotionFault fault) {
  return fault == MotionFault::not_linear || fault == MotionFault::undecided;
}

/// An equation that cannot be told wrong by a state is wrong by its form.
std::string decided_by(const MotionVerdict& found) {
  if (!found.counterexample.empty()) return "counterexample";
  if (found.decided_by == Decision::rounded) return "rule";
  return found.decided_by == Decision::values ? "values" : "identity";
}

Json counterexample_of(const EquationItem& item, const MotionVerdict& found, bool speaks_of_fixed) {
  const std::vector<SymbolDomain> symbols = item.formula->system.domains();
  Json json{{"state", state_json(*item.formula, symbols, found.counterexample)}};
  if (found.acceleration && !speaks_of_fixed)
    json[item.formula->scene().coordinates[0].name + "_ddot"] = *found.acceleration;
  return json;
}

/// The slip in a wrong equation, held against the right one of its coordinate or, where all are asked for, of
/// each.
Json diagnosis_of(const EquationItem& item, const ReadEquation& submitted) {
  const Model& model = item.formula->dynamics->model();
  Graph& graph = item.formula->graph();
  for (std::size_t i = 0; i < model.equations.equations.size(); ++i) {
    if (item.coordinate && *item.coordinate != i) continue;
    const Equation& equation = model.equations.equations[i];
    const Expression right =
        item.formula->system.with_fixed(graph.adopt(equation.left) - graph.adopt(equation.right));
    const Compared compared{.submitted = item.formula->system.with_momenta(submitted.residual()),
                            .expected = right,
                            .are_equations = true,
                            .inertia = inertia_changes(model, item.formula->system, i)};
    Json found = diagnosis_json(*item.formula, compared, item.seed, item.reveal);
    if (!found.is_null()) return found;
  }
  return nullptr;
}

void decide_equations(const EquationItem& item, std::span<const ReadEquation> equations, Verdict& verdict) {
  const ExpectedSystem& system = item.formula->system;
  std::vector<Expression> residuals;
  bool speaks_of_fixed = false;
  for (const ReadEquation& equation : equations) {
    const Expression residual = system.with_momenta(equation.residual());
    speaks_of_fixed = speaks_of_fixed || system.speaks_of_fixed(residual);
    residuals.push_back(system.with_fixed(residual));
  }
  const MotionVerdict found = compare_motion(system, residuals, item.coordinate, item.seed, item.tolerance);
  if (found.fault != MotionFault::none) {
    const bool is_of_one = found.fault == MotionFault::not_true || found.fault == MotionFault::holds_always;
    const std::string which =
        residuals.size() > 1 && is_of_one ? "Equation " + std::to_string(found.equation + 1) + ": " : "";
    verdict.feedback.push_back(which + sentence(found.fault));
  }
  if (has_no_verdict(found.fault)) return;
  verdict.correct = found.fault == MotionFault::none;
  verdict.decided_by = decided_by(found);
  if (!found.counterexample.empty()) verdict.counterexample = counterexample_of(item, found, speaks_of_fixed);
  if (found.fault != MotionFault::not_true) return;
  verdict.diagnosis = diagnosis_of(item, equations[found.equation]);
}

Json expected_equations(const EquationItem& item) {
  const Model& model = item.formula->dynamics->model();
  std::vector<ReadEquation> equations;
  for (std::size_t i = 0; i < model.equations.equations.size(); ++i) {
    if (item.coordinate && *item.coordinate != i) continue;
    Graph& graph = item.formula->graph();
    const Equation& equation = model.equations.equations[i];
    equations.push_back({graph.adopt(equation.left), graph.adopt(equation.right)});
  }
  if (!item.coordinate) {
    for (const ConstraintEquation& constraint : model.lagrangian.constraints) {
      Graph& graph = item.formula->graph();
      equations.push_back({graph.adopt(constraint.position.value_or(constraint.rate)), graph.number(0)});
    }
  }
  return all_written(*item.formula, equations);
}

/// Q_i; without the forces of constraints where L has them in it, as L + lambda phi.
Expression force_beside(const EquationItem& item, const Expression& lagrangian, std::size_t i) {
  const ExpectedSystem& system = item.formula->system;
  const std::vector<Expression>& multipliers = system.symbols().multipliers;
  Expression force = *system.quantity("Q_" + item.formula->scene().coordinates[i].name);
  if (!depends_on(lagrangian, multipliers)) return force;
  const std::vector<ConstraintEquation> constraints = system.constraints();
  for (std::size_t j = 0; j < multipliers.size(); ++j)
    force = force - multipliers[j] * constraints[j].slope[i];
  return force;
}

/// "L = ..." stands for the equations that follow from it: d/dt dL/dq' - dL/dq = Q.
std::vector<ReadEquation> equations_of_lagrangian(const EquationItem& item, const Expression& lagrangian) {
  const ExpectedSystem& system = item.formula->system;
  const Symbols::Varying& q = system.symbols().coordinates;
  std::vector<ReadEquation> equations;
  for (std::size_t i = 0; i < q.value.size(); ++i) {
    const Expression momentum = differentiate(lagrangian, q.rate[i]);
    const Expression left =
        total_derivative(momentum, item.formula->vocabulary.rates()) - differentiate(lagrangian, q.value[i]);
    equations.push_back({left, force_beside(item, lagrangian, i)});
  }
  return equations;
}

/// "L" at first, then perhaps "T - V".
bool begins_lagrangian(std::string_view left, bool is_first) {
  std::string letters;
  std::ranges::copy_if(left, std::back_inserter(letters), [](char c) {
    return std::string_view(" $\\{}\t\n(&").find(c) == std::string_view::npos;
  });
  constexpr std::array names{"L", "mathcalL", "mathscrL"};
  constexpr std::array differences{"T-V", "T-U", "K-V", "K-U"};
  return is_first ? std::ranges::find(names, letters) != names.end()
                  : std::ranges::find(differences, letters) != differences.end();
}

/// The text behind "L =" or "L = T - V =", where the whole submission is a Lagrangian and L is no symbol of
/// the system's.
std::optional<std::string> lagrangian_text(const EquationItem& item, const std::string& text) {
  if (item.coordinate || item.formula->vocabulary.find("L")) return std::nullopt;
  std::size_t behind = 0;
  for (std::size_t equals = text.find('='); equals != std::string::npos; equals = text.find('=', behind)) {
    if (!begins_lagrangian(text.substr(behind, equals - behind), behind == 0)) return std::nullopt;
    behind = equals + 1;
  }
  return behind == 0 ? std::nullopt : std::optional(text.substr(behind));
}

/// What was submitted in the place of equations, and the equations.
struct ReadMotion {
  Json understood{};
  std::vector<ReadEquation> equations{};
  std::vector<std::string> errors{};
};

ReadMotion read_lagrangian(const EquationItem& item, const std::string& text) {
  const ReadSubmission read = read_submission(text, item.formula->graph(), item.formula->vocabulary);
  if (!read.errors.empty()) return {.errors = read.errors};
  if (read.equations.size() != 1 || read.equations[0].right) return {.errors = {"one Lagrangian is needed"}};
  return {.understood = written(*item.formula, read.equations[0]),
          .equations = equations_of_lagrangian(item, read.equations[0].left)};
}

ReadMotion read_motion(const EquationItem& item, const std::string& text) {
  if (const auto lagrangian = lagrangian_text(item, text)) return read_lagrangian(item, *lagrangian);
  Vocabulary vocabulary = item.formula->vocabulary;
  std::string rest;
  try {
    rest = without_definitions(text, item.formula->system.symbols(), vocabulary);
  } catch (const Error& error) {
    return {.errors = {error.what()}};
  }
  const ReadSubmission read = read_submission(rest, item.formula->graph(), vocabulary);
  if (!read.errors.empty()) return {.errors = read.errors};
  return {.understood = all_written(*item.formula, read.equations), .equations = read.equations};
}

Verdict grade_equations(const EquationItem& item, const Json& submitted) {
  const auto text = text_of_equations(submitted);
  if (!text) return unreadable("Write the equation as a text.");
  const ReadMotion read = read_motion(item, *text);
  if (!read.errors.empty()) return {.format_errors = read.errors};
  if (read.equations.size() < item.fewest() || read.equations.size() > item.most())
    return unreadable(how_many(item, read.equations.size()));
  for (const ReadEquation& equation : read.equations) {
    if (!equation.right) return unreadable("an equation has an equals sign");
  }
  Verdict verdict;
  verdict.understood = read.understood;
  verdict.expected = expected_equations(item);
  decide_equations(item, read.equations, verdict);
  return verdict;
}

}  // namespace

std::optional<Grader> read_equation_item(const CheckItem& item, const std::string& kind,
                                         const ExpectationScope& scope, const Place& place, Errors& errors) {
  const Place expect = place.below("expect");
  auto formula = read_formula_system(item, kind, scope, place, errors);
  if (!formula) return std::nullopt;
  EquationItem read{.formula = formula,
                    .coordinate = {},
                    .tolerance = formula_tolerance(item, place, errors),
                    .seed = scope.seed,
                    .reveal = scope.reveal};
  if (item.expect.contains("of")) {
    const Json& of = item.expect["of"];
    std::vector<std::string> names;
    for (const Coordinate& coordinate : formula->scene().coordinates) names.push_back(coordinate.name);
    const auto found = std::ranges::find(names, of.is_string() ? of.get<std::string>() : "");
    if (found == names.end()) {
      FieldError error = expect.below("of").error(
          "unknown_coordinate", "'of' is the coordinate whose equation is asked for; without it, all are.");
      error.allowed = names;
      report(errors, std::move(error));
      return std::nullopt;
    }
    read.coordinate = static_cast<std::size_t>(found - names.begin());
  }
  return [read = std::move(read)](const Json& submitted) { return grade_equations(read, submitted); };
}

}  // namespace qdot::api
