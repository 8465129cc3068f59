#include "core/closed/asked_of_turning.hpp"

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/closed/barriers.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/special_angles.hpp"

namespace qdot {

void ask_coefficients(const Expression& potential, const Expression& x, AssumedSigns& signs) {
  Graph& graph = x.graph();
  std::map<Monomial, Polynomial, LeadingFirst> coefficients;
  for (const auto& [monomial, number] : multiplied_out(potential)) {
    Monomial varying, constant;
    for (const Atom& atom : monomial)
      (depends_on(Expression(graph, atom.base), x) ? varying : constant).push_back(atom);
    if (!varying.empty()) add(coefficients[varying], constant, number);
  }
  for (const auto& [varying, coefficient] : coefficients) {
    signs.ask(to_expression(graph, coefficient));
  }
}

void ask_parts(const Expression& formula, AssumedSigns& signs) {
  Graph& graph = formula.graph();
  const NodeId root = formula.id();
  signs.ask(formula);
  for (const NodeId id : reachable(graph, {&root, 1})) {
    if (std::holds_alternative<Sum>(graph.node(id))) signs.ask(Expression(graph, id));
  }
}

namespace {

/// a of a^2, 3*a of 9*a^2.
std::optional<Expression> sqrt_of_square(const Expression& e) {
  const auto [coefficient, rest] = split_coefficient(e);
  const auto* power = std::get_if<Power>(&rest.node());
  if (power == nullptr || coefficient.is_negative() || power->exponent != Number(2)) return std::nullopt;
  const auto number = exact_root(coefficient);
  if (!number) return std::nullopt;
  return *number * Expression(e.graph(), power->base);
}

/// What is positive where two squares differ so: a - b and a + b of a^2 - b^2.
void ask_about_squares(const Expression& difference, AssumedSigns& signs) {
  const auto* sum = std::get_if<Sum>(&difference.node());
  if (sum == nullptr || sum->terms.size() != 2) return;
  Graph& graph = difference.graph();
  const Expression first(graph, sum->terms[0]), second(graph, sum->terms[1]);
  const auto root = [](const Expression& e) { return sqrt_of_square(e); };
  const auto a = root(first), b = root(-second);
  if (a && b) {
    signs.ask(*a - *b);
    signs.ask(*a + *b);
  }
  const auto c = root(-first), d = root(second);
  if (c && d) {
    signs.ask(*d - *c);
    signs.ask(*d + *c);
  }
}

}  // namespace

void ask_values(const Expression& formula, AssumedSigns& signs) {
  constexpr std::size_t long_formula = 50;
  if (written_length(formula) > long_formula) return;
  signs.ask_for_value_of(formula);
  Graph& graph = formula.graph();
  const NodeId root = formula.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (power != nullptr && (power->exponent.denominator() / Number(2)).is_integer())
      ask_about_squares(Expression(graph, power->base), signs);
    if (call == nullptr || (call->function != Function::acos && call->function != Function::asin)) continue;
    const Expression inside(graph, call->argument);
    signs.ask(graph.number(1) - inside * inside);
  }
}

void ask_between(const QuadratureProblem& problem, const Expression& place, AssumedSigns& signs) {
  constexpr std::size_t long_place = 20;
  if (written_length(place) > long_place) return;
  try {
    for (const Expression& e :
         {problem.energy - problem.potential, differentiate(problem.potential, problem.x)})
      signs.ask(with_special_angles(with_value(e, problem.x, place)));
  } catch (const Error&) {  // there is a pole
  }
}

namespace {

/// Whether the start lies within the turn about 0 of the angles that the potential speaks of: arcs of cosines
/// do.
void ask_turn_of_start(const QuadratureProblem& problem, const Expression& start, AssumedSigns& signs) {
  Graph& graph = start.graph();
  const NodeId root = problem.potential.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr || (call->function != Function::sin && call->function != Function::cos &&
                            call->function != Function::tan))
      continue;
    if (!depends_on(Expression(graph, call->argument), problem.x)) continue;
    const Expression angle = with_value(Expression(graph, call->argument), problem.x, start);
    const Expression turn =
        call->function == Function::tan ? Number::ratio(1, 2) * graph.symbol("pi") : graph.symbol("pi");
    signs.ask(turn - angle);
    signs.ask(turn + angle);
  }
}

bool has_logarithm_of(const Expression& e, const Expression& x) {
  const NodeId root = e.id();
  return std::ranges::any_of(reachable(e.graph(), {&root, 1}), [&](NodeId id) {
    const auto* call = std::get_if<Call>(&e.graph().node(id));
    return call != nullptr && call->function == Function::log && call->argument == x.id();
  });
}

}  // namespace

void ask_about(const TurningEquation& equation, const QuadratureProblem& problem, AssumedSigns& signs) {
  ask_between(problem, equation.graph->number(0), signs);
  const bool is_angle = equation.values.model().scene.coordinates[equation.found.coordinate].unit == "rad";
  if (is_angle) ask_between(problem, equation.graph->symbol("pi"), signs);
  if (has_logarithm_of(problem.potential, equation.x)) ask_between(problem, equation.graph->number(1), signs);
  for (const Expression& place :
       places_of_barriers(factors_of_inertia(problem.inertia, problem.x), problem.x))
    ask_between(problem, place, signs);
  if (const auto start = equation.start()) ask_turn_of_start(problem, *start, signs);
}

}  // namespace qdot
