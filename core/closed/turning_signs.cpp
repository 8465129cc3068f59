#include "core/closed/turning_signs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.hpp"
#include "core/closed/assumed_signs.hpp"
#include "core/closed/barriers.hpp"
#include "core/closed/speed_at.hpp"
#include "core/closed/trial.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/special_angles.hpp"

namespace qdot {

std::vector<Expression> not_spoken_of(const TurningEquation& equation,
                                      const std::vector<std::string>& assumes,
                                      const std::vector<Expression>& constants) {
  std::vector<Expression> symbols = equation.values.symbols();
  symbols.insert(symbols.end(), constants.begin(), constants.end());
  std::erase_if(symbols, [&](const Expression& symbol) {
    const std::string name = print(symbol, Form::text);
    return std::ranges::any_of(assumes, [&](const std::string& assumed) {
      return assumed == name + " > 0" || assumed == name + " < 0" || assumed.starts_with(name + " = ");
    });
  });
  return symbols;
}

namespace {

constexpr int tries_anywhere = 48;
constexpr int tries_of_start = 480;

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
    signs.ask(to_expression(graph, coefficient));
  }
}

/// The same parameters, with the constants of the motion that the equation's start gives it, where it is
/// known exactly and they have the signs that they are said to have.
AssumedSigns::OtherPlace with_start(const TurningEquation& equation, const std::vector<Expression>& free) {
  if (!equation.energy) return [](const FarPlace&) { return std::nullopt; };
  std::vector<Replacement> constants = equation.momenta;
  constants.emplace_back(equation.energy_symbol, *equation.energy);
  return [&equation, constants, free](const FarPlace& place) -> std::optional<FarPlace> {
    FarPlace there = place;
    for (const auto& [symbol, value] : constants) {
      const Real number = evaluate_exactly(value, place);
      const auto other = std::ranges::find(there, symbol, &RealAssignment::first);
      if (other == there.end() || !number.is_finite()) return std::nullopt;
      const bool is_free = std::ranges::find(free, symbol) != free.end();
      if (!is_free && !(number.value * equation.values.value(symbol).value > 0)) return std::nullopt;
      other->second = number;
    }
    return there;
  };
}

/// Where the motion begins at a far place; none where that says nothing of its start.
class FarStart {
 public:
  FarStart(const TurningEquation& equation, bool by_start)
      : equation_(equation), by_start_(by_start), x0_(equation.start()) {}

  [[nodiscard]] std::optional<double> at(const FarPlace& place) const {
    if (!x0_ || !(by_start_ || is_that_of_start(place))) return std::nullopt;
    const Real x = evaluate_exactly(*x0_, place);
    return x.is_finite() ? std::optional(x.value) : std::nullopt;
  }

 private:
  /// Not by chance.
  static bool is_near(double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(a); }

  [[nodiscard]] bool is_that_of_start(const FarPlace& place) const {
    if (!equation_.energy) return false;
    const auto has = [&](const Expression& symbol, const Expression& value) {
      const auto given = std::ranges::find(place, symbol, &RealAssignment::first);
      return given != place.end() && (is_near(given->second.value, rough_value(value, place)) ||
                                      given->second.value == evaluate_exactly(value, place).value);
    };
    const auto is_momentum = [&](const Replacement& p) { return has(p.first, p.second); };
    return has(equation_.energy_symbol, *equation_.energy) &&
           std::ranges::all_of(equation_.momenta, is_momentum);
  }

  const TurningEquation& equation_;
  bool by_start_;
  std::optional<Expression> x0_;
};

/// The sums of a formula, what it divides by, and what it takes roots of.
void ask_parts(const Expression& formula, AssumedSigns& signs) {
  Graph& graph = formula.graph();
  const NodeId root = formula.id();
  signs.ask(formula);
  for (const NodeId id : reachable(graph, {&root, 1})) {
    if (std::holds_alternative<Sum>(graph.node(id))) signs.ask(Expression(graph, id));
  }
}

/// What is left of the energy at a place between the ends, and which way the force goes there.
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

using Needed = std::optional<std::vector<std::string>>;

/// What is needed, and where no sign tells, what the force at the start tells beside it.
Needed with_force_at_start(const TurningEquation& equation, const QuadratureProblem& problem, bool by_start,
                           AssumedSigns& signs, const std::function<Needed()>& needed) {
  const Needed without = needed();
  const auto start = equation.start();
  if (without || !start) return without;
  ask_between(problem, *start, signs);
  Needed with = needed();
  if (with && !by_start)
    with->push_back(print(equation.x, Form::text) + "(0) = " + print(*start, Form::text));
  return with;
}

/// A formula of an end of the motion.
class End {
 public:
  End(const TurningEquation& equation, const Expression& x, int side, const Relations& relations)
      : equation_(equation),
        relations_(relations),
        side_(side),
        by_start_(!equation.assumed.empty()),
        problem_{equation.x, equation.inertia, equation.potential, equation.energy_symbol},
        place_(short_form(equation.values, x)),
        trial_(equation.values, relations),
        start_(equation, by_start_) {
    if (by_start_) {
      problem_ = {equation.x, substitute(equation.inertia, equation.momenta),
                  substitute(equation.potential, equation.momenta), *equation.energy};
    }
    force_ = differentiate(problem_.potential, equation.x);
    back_ = side > 0 ? force_ : -force_;
    said_.emplace(equation, force_);
    trial_.only_where_real();
    trial_.set({equation.x}, {place_});
    trial_.vanishes(terms_of(problem_.potential - problem_.energy));
    trial_.is_positive(back_);
  }

  [[nodiscard]] std::optional<std::vector<std::string>> signs(const std::vector<std::string>& assumes) {
    const std::vector<Expression> constants = equation_.free_constants();
    AssumedSigns signs(equation_.values, relations_, constants);
    const std::vector<Expression> free = not_spoken_of(equation_, assumes, constants);
    signs.let_go(free,
                 by_start_ ? [](const FarPlace&) -> std::optional<FarPlace> { return std::nullopt; }
                           : with_start(equation_, free));
    signs.ask(with_value(back_, equation_.x, place_));
    for (const Expression& e : inside_domain(domain(), place_)) signs.ask(e);
    ask_coefficients(problem_.potential, equation_.x, signs);
    ask_parts(place_, signs);
    ask_about(equation_, problem_, signs);
    if (const auto x0 = equation_.start()) ask_between(problem_, Number::ratio(1, 2) * (*x0 + place_), signs);
    return with_force_at_start(equation_, problem_, by_start_, signs, [&] {
      tried_ = 0;
      return signs.separating([&](const FarPlace& far) { return holds_at(far); },
                              by_start_ ? tries_of_start : tries_anywhere / 2,
                              by_start_ ? 0 : tries_of_start);
    });
  }

 private:
  /// It claims nothing where the formula has no value, or the motion begins elsewhere than is said.
  [[nodiscard]] std::optional<Claim> holds_at(const FarPlace& far) {
    const Real end = evaluate_exactly(place_, far);
    if (!end.is_finite() || !said_->is_as_said(far)) return std::nullopt;
    const std::optional<double> x0 = start_.at(far);
    if (x0 && !domain().contains(*x0)) return std::nullopt;
    if (!domain().contains(end.value)) return Claim{};
    if (!is_heavy(problem_, x0 ? *x0 : end.value, far)) return std::nullopt;
    const bool is_tried = !x0 || tried_++ < tries_anywhere;  // what it says is the same everywhere
    if (is_tried && !trial_.holds_at(far)) return Claim{};
    if (!x0) return Claim{.holds = true};
    if (is_other_side(*x0, end.value)) return Claim{};
    if (!speed_) speed_.emplace(problem_, far);
    const SquaredSpeed e = speed_->at(far);
    const std::optional<Rooms> rooms = room_to_come(e, *x0, end.value);
    return rooms ? Claim{true, {rooms->on_the_way, rooms->in_the_middle}} : Claim{};
  }

  [[nodiscard]] bool is_other_side(double x0, double end) const {
    const double rounding = 1e-9 * (std::abs(x0) + std::abs(end));
    return side_ * (end - x0) < -rounding;
  }

  [[nodiscard]] const Domain& domain() const {
    return equation_.values.model().scene.coordinates[equation_.found.coordinate].domain;
  }

  const TurningEquation& equation_;
  const Relations& relations_;
  int side_;
  bool by_start_;
  QuadratureProblem problem_;
  Expression place_;
  Expression force_{place_}, back_{place_};  ///< towards smaller x, and away from the end
  Trial trial_;
  FarStart start_;
  std::optional<Start> said_;
  std::optional<SpeedAt> speed_;
  int tried_{};
};

}  // namespace

std::optional<std::vector<std::string>> signs_of_extremum(const TurningEquation& equation,
                                                          const Expression& x, int side,
                                                          const Relations& relations,
                                                          const std::vector<std::string>& assumes) {
  auto signs = End(equation, x, side, relations).signs(assumes);
  return signs ? std::optional(without_impacts(equation, *std::move(signs))) : std::nullopt;
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

std::optional<std::vector<std::string>> signs_of_period(const TurningEquation& equation,
                                                        const QuadratureProblem& problem,
                                                        const PeriodFormula& period,
                                                        const WallPlaces& walls) {
  const bool by_start = problem.energy != equation.energy_symbol;
  const std::vector<Expression> constants = by_start ? std::vector<Expression>{} : equation.constants;
  AssumedSigns signs(equation.values, period.relations, constants);
  const std::vector<Expression> free = not_spoken_of(equation, period.form.assumes, constants);
  signs.let_go(free,
               by_start ? [](const FarPlace&) -> std::optional<FarPlace> { return std::nullopt; }
                        : with_start(equation, free));
  ask_coefficients(problem.potential, problem.x, signs);
  ask_parts(period.factor, signs);
  if (period.m) ask_parts(*period.m, signs);
  ask_about(equation, problem, signs);
  const FarStart begin(equation, by_start);
  std::optional<SpeedAt> speed;
  const auto has_period = [&](const FarPlace& far) -> std::optional<Claim> {
    const double number = period.value_at(far);
    if (!std::isfinite(number)) return std::nullopt;
    if (!speed) speed.emplace(problem, far);
    SquaredSpeed e = speed->at(far);
    e.start = begin.at(far);
    if (e.start && !is_heavy(problem, *e.start, far)) return std::nullopt;
    if (walls.below) e.below = evaluate_exactly(*walls.below, far).value;
    if (walls.above) e.above = evaluate_exactly(*walls.above, far).value;
    const bool turns = equation.found.motion == MotionKind::rotation;
    return Claim{turns ? may_turn_with(e, number) : may_swing_with(e, number)};
  };
  Needed needed = with_force_at_start(equation, problem, by_start, signs, [&] {
    return signs.separating(has_period, by_start ? tries_of_start : tries_anywhere,
                            by_start ? 0 : tries_of_start);
  });
  return needed ? std::optional(without_impacts(equation, *std::move(needed))) : std::nullopt;
}

}  // namespace qdot
