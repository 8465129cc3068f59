#include "core/closed/turning_signs.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/closed/asked_of_turning.hpp"
#include "core/closed/assumed_signs.hpp"
#include "core/closed/barriers.hpp"
#include "core/closed/even_ways.hpp"
#include "core/closed/speed_at.hpp"
#include "core/closed/trial.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/rational_function.hpp"
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

/// Of a formula that has no value where a motion begins, which it ought to have if that is asked for.
std::optional<Claim> not_real(const QuadratureProblem& problem, const std::optional<double>& start,
                              const FarPlace& far, bool only_real) {
  if (!only_real || !start || !is_heavy(problem, *start, far)) return std::nullopt;
  return Claim{.is_real = false};
}

/// With signs that tell where it is real, or else where there are none, those of where it has a value.
Needed real_if_possible(const std::function<Needed(bool only_real)>& needed) {
  Needed real = needed(true);
  return real ? real : needed(false);
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
    if (const auto x0 = equation_.start()) ask_of_way(*x0, signs);
    ask_values(place_, signs);
    return real_if_possible([&](bool only_real) {
      return with_force_at_start(equation_, problem_, by_start_, signs, [&] {
        tried_ = 0;
        return signs.separating([&](const FarPlace& far) { return holds_at(far, only_real); },
                                by_start_ ? tries_of_start : tries_anywhere / 2,
                                by_start_ ? 0 : tries_of_start);
      });
    });
  }

 private:
  /// From the start to the end, which is as far from 0 where the potential is even.
  void ask_of_way(const Expression& x0, AssumedSigns& signs) const {
    const Expression both = x0 + place_;
    ask_between(problem_, Number::ratio(1, 2) * both, signs);
    if (rational_function(both).is_zero()) ask_about_hills(problem_, x0, equation_.values, signs);
  }

  /// It claims nothing where the formula has no value, or the motion begins elsewhere than is said.
  [[nodiscard]] std::optional<Claim> holds_at(const FarPlace& far, bool only_real) {
    if (!said_->is_as_said(far)) return std::nullopt;
    const std::optional<double> x0 = start_.at(far);
    if (x0 && !domain().contains(*x0)) return std::nullopt;
    const Real end = evaluate_exactly(place_, far);
    if (!end.is_finite()) return not_real(problem_, x0, far, only_real);
    if (!domain().contains(end.value)) return Claim{};
    if (!is_heavy(problem_, x0 ? *x0 : end.value, far)) return std::nullopt;
    const bool is_tried = !x0 || tried_++ < tries_anywhere;  // what it says is the same everywhere
    if (is_tried && !trial_.holds_at(far)) return Claim{};
    if (!x0) return Claim{.holds = true};
    if (is_other_side(*x0, end.value)) return Claim{};
    if (!speed_) speed_.emplace(problem_, far);
    const SquaredSpeed e = speed_->at(far);
    if (is_passed(e, *x0, end.value)) return std::nullopt;
    const std::optional<Rooms> rooms = room_to_come(e, *x0, end.value);
    return rooms ? Claim{true, {rooms->on_the_way, rooms->in_the_middle}} : Claim{};
  }

  /// Whether the motion is nearly as fast there as half way: it is another root, or rounding next to a pole,
  /// and tells nothing.
  static bool is_passed(const SquaredSpeed& e, double x0, double end) {
    constexpr double near = 1e-3;
    if (std::abs(end - x0) <= near * (std::abs(x0) + std::abs(end))) return false;
    return std::abs(e.at(end)) > near * std::abs(e.at(x0 + (end - x0) / 2));
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
  ask_values(period.factor, signs);
  if (period.m) signs.ask(period.m->graph().number(1) - *period.m);
  const FarStart begin(equation, by_start);
  std::optional<SpeedAt> speed;
  const auto has_period = [&](const FarPlace& far, bool only_real) -> std::optional<Claim> {
    const double number = period.value_at(far);
    if (!std::isfinite(number)) return not_real(problem, begin.at(far), far, only_real);
    if (!speed) speed.emplace(problem, far);
    SquaredSpeed e = speed->at(far);
    e.start = begin.at(far);
    if (e.start && !is_heavy(problem, *e.start, far)) return std::nullopt;
    if (walls.below) e.below = evaluate_exactly(*walls.below, far).value;
    if (walls.above) e.above = evaluate_exactly(*walls.above, far).value;
    const bool turns = equation.found.motion == MotionKind::rotation;
    return Claim{turns ? may_turn_with(e, number) : may_swing_with(e, number)};
  };
  Needed needed = real_if_possible([&](bool only_real) {
    return with_force_at_start(equation, problem, by_start, signs, [&] {
      return signs.separating([&](const FarPlace& far) { return has_period(far, only_real); },
                              by_start ? tries_of_start : tries_anywhere, by_start ? 0 : tries_of_start);
    });
  });
  return needed ? std::optional(without_impacts(equation, *std::move(needed))) : std::nullopt;
}

}  // namespace qdot
