#include "core/closed/turning_signs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/closed/assumed_signs.hpp"
#include "core/closed/rough_period.hpp"
#include "core/closed/trial.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"

namespace qdot {
namespace {

using FarPlace = std::vector<RealAssignment>;

Expression with_value(const Expression& e, const Expression& x, const Expression& value) {
  const Replacement there{x, value};
  return substitute(e, {&there, 1});
}

/// Whether a motion that is said to begin at an end does so there.
class Start {
 public:
  explicit Start(const TurningEquation& equation, const Expression& force) {
    const auto start = equation.assumed.empty() ? std::nullopt : equation.start();
    const InitialPlace place = equation.found.initial;
    if (!start || (place != InitialPlace::maximum && place != InitialPlace::minimum)) return;
    const Expression outwards = place == InitialPlace::maximum ? force : -force;
    positive_ = with_value(outwards, equation.x, *start);
  }
  [[nodiscard]] bool is_as_said(const FarPlace& place) const {
    return !positive_ || evaluate_exactly(*positive_, place).value > 0;
  }

 private:
  std::optional<Expression> positive_;
};

/// The energy integral knows of none but walls that turn the motion.
std::vector<std::string> without_impacts(const TurningEquation& equation, std::vector<std::string> signs) {
  const bool has_impacts = !equation.values.model().parsed.impacts.empty();
  if (has_impacts && !equation.found.walls) signs.emplace_back("the motion comes to no impact");
  return signs;
}

/// Those of what functions of x have for factors: (A - B) of (A - B)/sin(x)^2.
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
    if (coefficient.size() > 1) signs.ask(to_expression(graph, coefficient));
  }
}

/// The same parameters, with the constants of the motion that the equation's start gives it, where it is
/// known exactly and they have the signs that they are said to have.
std::optional<FarPlace> with_start(const TurningEquation& equation, const FarPlace& place) {
  if (!equation.energy) return std::nullopt;
  FarPlace there = place;
  std::vector<Replacement> constants = equation.momenta;
  constants.emplace_back(equation.energy_symbol, *equation.energy);
  for (const auto& [symbol, value] : constants) {
    const Real number = evaluate_exactly(value, place);
    const auto other = std::ranges::find(there, symbol, &RealAssignment::first);
    if (other == there.end() || !(number.value * other->second.value > 0)) return std::nullopt;
    other->second = number;
  }
  return there;
}

/// Whether the motion has e > 0 all the way from its start to there.
bool comes_from_start(const SquaredSpeed& e, double start, double end) {
  constexpr int places = 64;
  for (int i = 1; i < places; ++i) {
    if (!(e.at(start + (end - start) * i / places) > 0)) return false;
  }
  return true;
}

/// v^2 with numbers in place of all but x.
class SpeedAt {
 public:
  SpeedAt(const QuadratureProblem& problem, const FarPlace& like) {
    std::vector<Expression> symbols;
    for (const auto& [symbol, value] : like) symbols.push_back(symbol);
    Graph& graph = problem.x.graph();
    TapeBuilder tape(graph, symbols, graph.symbol("t"), {&problem.x, 1});
    tape.output(Number(2) * (problem.energy - problem.potential) / problem.inertia);
    function_ = tape.finish();
  }

  [[nodiscard]] SquaredSpeed at(const FarPlace& place) const {
    std::vector<double> numbers;
    for (const auto& [symbol, value] : place) numbers.push_back(value.value);
    return {.at = [this, workspace = function_.bind(numbers)](double x) mutable {
      double e = 0;
      const bool is_known = function_.evaluate(0, {&x, 1}, workspace, {&e, 1}) == Evaluation::ok;
      return is_known ? e : std::numeric_limits<double>::quiet_NaN();
    }};
  }

 private:
  CompiledFunction function_;
};

}  // namespace

std::vector<std::string> signs_of_extremum(const TurningEquation& equation, const Expression& x, int side,
                                           const Relations& relations) {
  const bool by_start = !equation.assumed.empty();
  const auto with_constants = [&](const Expression& e) {
    return by_start ? substitute(e, equation.momenta) : e;
  };
  const Expression potential = with_constants(equation.potential);
  const Expression energy = by_start ? *equation.energy : equation.energy_symbol;
  const Expression force = differentiate(potential, equation.x);  // towards smaller x
  const Expression place = short_form(equation.values, x);
  AssumedSigns signs(equation.values, relations, by_start ? std::vector<Expression>{} : equation.constants);
  const Expression back = side > 0 ? force : -force;
  signs.ask(with_value(back, equation.x, place));
  ask_coefficients(potential, equation.x, signs);
  if (!signs.are_there()) return without_impacts(equation, {});
  Trial trial(equation.values, relations);
  trial.only_where_real();
  trial.set({equation.x}, {place});
  trial.vanishes(terms_of(potential - energy));
  trial.is_positive(back);
  const Start start(equation, force);
  const std::optional<Expression> x0 = by_start ? std::nullopt : equation.start();
  std::optional<SpeedAt> speed;
  const auto is_reached = [&](const FarPlace& far) {
    const auto there = x0 ? with_start(equation, far) : std::nullopt;
    const Real end = there ? evaluate_exactly(place, *there) : Real(0);
    if (!there || !end.is_finite()) return true;
    if (!speed) speed.emplace(QuadratureProblem{equation.x, equation.inertia, potential, energy}, *there);
    const double begin = evaluate_exactly(*x0, *there).value;
    return trial.holds_at(*there) && comes_from_start(speed->at(*there), begin, end.value);
  };
  return without_impacts(equation, signs.needed_for([&](const FarPlace& far) {
    return !start.is_as_said(far) || (trial.holds_at(far) && is_reached(far));
  }));
}

std::vector<std::string> signs_of_wall(const TurningEquation& equation, const Expression& wall) {
  if (!equation.by_constants) return {};
  const Relations none;
  const Expression left = equation.energy_symbol - with_value(equation.potential, equation.x, wall);
  AssumedSigns signs(equation.values, none, equation.constants);
  signs.ask(left);
  if (!signs.are_there()) return {};
  return signs.needed_for([&](const FarPlace& far) { return evaluate_exactly(left, far).value > 0; });
}

std::vector<std::string> signs_of_period(const TurningEquation& equation, const QuadratureProblem& problem,
                                         const PeriodFormula& period, const WallPlaces& walls) {
  const bool by_start = problem.energy != equation.energy_symbol;
  AssumedSigns signs(equation.values, period.relations,
                     by_start ? std::vector<Expression>{} : equation.constants);
  ask_coefficients(problem.potential, problem.x, signs);
  if (!signs.are_there()) return without_impacts(equation, {});
  std::optional<SpeedAt> speed;
  const auto has_period = [&](const FarPlace& far, std::optional<double> start) {
    const double number = period.value_at(far);
    if (!std::isfinite(number)) return true;
    if (!speed) speed.emplace(problem, far);
    SquaredSpeed e = speed->at(far);
    e.start = start;
    if (walls.below) e.below = evaluate_exactly(*walls.below, far).value;
    if (walls.above) e.above = evaluate_exactly(*walls.above, far).value;
    return equation.found.motion == MotionKind::rotation ? may_turn_with(e, number)
                                                         : may_swing_with(e, number);
  };
  const std::optional<Expression> x0 = equation.start();
  return without_impacts(equation, signs.needed_for([&](const FarPlace& far) {
    if (!has_period(far, {})) return false;
    const auto there = x0 && !by_start ? with_start(equation, far) : std::nullopt;
    return !there || has_period(*there, evaluate_exactly(*x0, *there).value);
  }));
}

}  // namespace qdot
