#include "core/turning/turning_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/short_number.hpp"
#include "core/dynamics/missing_values.hpp"
#include "core/expr/full_turn.hpp"
#include "core/numerics/constants.hpp"
#include "core/turning/energy_problem.hpp"
#include "core/turning/impacts_on_the_way.hpp"
#include "core/turning/oscillation_period.hpp"
#include "core/turning/rest.hpp"
#include "core/turning/turning_search.hpp"

namespace qdot {
namespace {

Range range_of(const Coordinate& q, const Reduction& reduction) {
  Range range{q.domain, std::nullopt};
  const bool bounded = std::isfinite(q.domain.lower) || std::isfinite(q.domain.upper);
  if (q.unit == "rad" && !bounded && has_full_turn(reduction.routhian, reduction.x[0])) {
    range.period = std::nextafter(2 * std::numbers::pi, infinity);
  }
  return range;
}

void check_start(EnergyBalance& energy, const std::string& name) {
  const double x0 = energy.x0();
  if (!(energy.inertia(x0).lower > 0) || !energy.potential(x0).is_finite() ||
      !energy.potential_rate(x0).is_finite() || !std::isfinite(energy.kinetic_energy().upper)) {
    throw Error(ErrorCode::invalid_state, "In the initial state the effective potential or the inertia of " +
                                              name + " has no finite positive value.");
  }
}

/// One more step of Newton's with twice the digits, to the double nearest to the place.
void sharpen(EnergyBalance& energy, MotionBound& bound) {
  const double m = bound.place.middle();
  const Interval offset = energy.remaining_sharply(m) / energy.potential_rate(bound.place);
  const Interval next = intersection(Interval(m) + offset, bound.place);
  if (is_empty(next) || !offset.is_finite()) return;
  const double nearest = m + offset.middle();
  const double half_unit = (std::nextafter(std::abs(nearest), infinity) - std::abs(nearest)) / 2;
  const double error = std::max(half_unit, (offset + (Interval(m) - Interval(nearest))).magnitude());
  if (error < next.radius()) bound.nearest = {nearest, error};
  bound.place = next;
}

struct MotionBounds {
  MotionBound down, up;
};

/// From rest the motion goes to one side only.
MotionBounds bounds_of(EnergyBalance& energy, const Range& range) {
  const auto bound = [&](Direction direction) {
    MotionBound found = TurningSearch(energy, range, direction).run();
    if (found.kind == MotionBound::Kind::turning) sharpen(energy, found);
    return found;
  };
  const MotionBound start{MotionBound::Kind::turning, energy.start()};
  const double pull = energy.potential_rate_at_start().middle();
  const bool moves = !energy.starts_at_rest();
  MotionBounds bounds{start, start};
  if (moves || pull < 0) bounds.up = bound(Direction::up);
  if (moves || pull > 0) bounds.down = bound(Direction::down);
  return bounds;
}

/// No value where a bound is unresolved, or the end of the domain or of the potential.
std::optional<MotionKind> kind_of(const MotionBounds& bounds) {
  using Kind = MotionBound::Kind;
  const auto either = [&](Kind kind) { return bounds.down.kind == kind || bounds.up.kind == kind; };
  if (either(Kind::unresolved) || either(Kind::near_end) || either(Kind::fall) || either(Kind::no_value) ||
      either(Kind::no_inertia) || either(Kind::endless_inertia))
    return std::nullopt;
  if (either(Kind::asymptote)) return MotionKind::separatrix;
  if (either(Kind::domain_end)) return std::nullopt;
  if (either(Kind::full_turn)) return MotionKind::rotation;
  return either(Kind::unbounded) ? MotionKind::unbounded : MotionKind::libration;
}

/// What the bound says that leaves the kind of motion open.
std::string why_kind_is_open(const MotionBounds& bounds, const TurningPoints& answer) {
  using Kind = MotionBound::Kind;
  for (const auto kind : {Kind::unresolved, Kind::near_end, Kind::fall, Kind::no_value, Kind::no_inertia,
                          Kind::endless_inertia, Kind::domain_end}) {
    if (bounds.down.kind == kind) return answer.minimum.reason;
    if (bounds.up.kind == kind) return answer.maximum.reason;
  }
  return "";
}

Finding period_of(EnergyBalance& energy, const TurningPoints& answer, const MotionBounds& bounds) {
  if (!answer.motion) return {std::nullopt, 0, answer.motion_reason};
  if (answer.motion == MotionKind::libration)
    return libration_period(energy, bounds.down.place, bounds.up.place);
  if (answer.motion == MotionKind::rotation) return rotation_period(energy);
  return {std::nullopt, 0, why_not_periodic(*answer.motion)};
}

/// One for each condition, without values.
std::vector<ValidityMinimum> no_minima(const Model& model, const std::string& reason) {
  std::vector<ValidityMinimum> minima(model.validity.size());
  for (std::size_t i = 0; i < minima.size(); ++i) {
    minima[i].condition = i;
    minima[i].reason = reason;
  }
  return minima;
}

/// The energy integral knows nothing of places where other coordinates lose their meaning: a change of sign
/// of a `singular_where` expression on the way.
std::vector<std::string> singular_places(const Scene& scene, EnclosedMotion& motion) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < scene.singular_where.size(); ++i) {
    const std::string& message = scene.singular_where[i].message;
    switch (motion.vanishes(i)) {
      case Vanishes::never:
        break;
      case Vanishes::changes_sign:
        notes.push_back("On its way the motion passes a singular place: " + message);
        break;
      case Vanishes::undecided:
        notes.push_back("On its way the motion may come to a singular place: " + message);
        break;
    }
  }
  return notes;
}

const Interval turn = Interval(2) * Interval(std::nextafter(pi, 0), std::nextafter(pi, 4));

class Question {
 public:
  Question(const Dynamics& dynamics, const EnergyProblem& problem, const Reals& parameters, const Reals& y0,
           const BesideExtrema& beside)
      : beside_(beside),
        dynamics_(dynamics),
        problem_(problem),
        parameters_(parameters),
        y0_(y0),
        x0_(y0[problem.coordinate]),
        x0_dot_(y0[y0.size() / 2 + problem.coordinate]),
        energy_(*problem.statics, problem.constants, y0.exact(problem.coordinate),
                y0.exact(y0.size() / 2 + problem.coordinate)) {}

  TurningPoints answer() {
    const Coordinate& q = dynamics_.model().scene.coordinates[problem_.coordinate];
    answer_.coordinate = problem_.coordinate;
    for (std::size_t i = parameters_.size(); i < problem_.constants.size(); ++i) {
      answer_.momenta.push_back(problem_.constants[i].value());
      answer_.momenta_errors.push_back(problem_.constants[i].error());
    }
    check_start(energy_, q.name);
    answer_.energy = {energy_.energy().value(), energy_.energy().error(), ""};
    if (energy_.starts_at_rest() && !departs_from_rest(energy_)) {
      stay(q.name);
    } else {
      move(q);
    }
    return std::move(answer_);
  }

 private:
  /// Rest in an equilibrium, as far as the numbers tell.
  void stay(const std::string& name) {
    const auto rest = resting_place(energy_);
    if (!rest) {
      answer_.maximum.reason = answer_.minimum.reason = answer_.motion_reason = answer_.period.reason =
          why_rest_is_undecided(name);
      return;
    }
    answer_.maximum = answer_.minimum = {x0_, rest->error + energy_.distance_from_start(), ""};
    answer_.motion = MotionKind::equilibrium;
    answer_.initial = InitialPlace::equilibrium;
    answer_.stability = rest->stability;
    answer_.period.reason = problem_.original->reduction.ignored.empty()
                                ? why_not_periodic(MotionKind::equilibrium)
                                : name +
                                      " stays as it is while ignorable coordinates may go on: it has no "
                                      "period of its own.";
    if (rest->stability == "unstable" && rest->error > 0) {
      answer_.notes.push_back("The equilibrium is unstable, and " + name +
                              " is the nearest number to it: the least push carries the system away.");
    }
    const PeriodicWay here{energy_.start(), energy_.start(), true};
    answer_.impact = impact_on(here);
    if (!beside_.along) return;
    answer_.validity = minima_along([this](double) { return std::pair(x0_, 0.0); }, here);
  }

  void move(const Coordinate& q) {
    const MotionBounds bounds = bounds_of(energy_, range_of(q, problem_.original->reduction));
    if (energy_.starts_at_rest()) {
      const bool rises = energy_.potential_rate_at_start().middle() < 0;
      answer_.initial = rises ? InitialPlace::minimum : InitialPlace::maximum;
    }
    answer_.maximum = extremum_at(bounds.up, q.name);
    answer_.minimum = extremum_at(bounds.down, q.name);
    if (answer_.initial == InitialPlace::minimum) answer_.minimum = {x0_, energy_.distance_from_start(), ""};
    if (answer_.initial == InitialPlace::maximum) answer_.maximum = {x0_, energy_.distance_from_start(), ""};
    if (bounces(bounds, q.name)) return;
    answer_.motion = kind_of(bounds);
    if (!answer_.motion) answer_.motion_reason = why_kind_is_open(bounds, answer_);
    const std::optional<PeriodicWay> way = way_of(bounds);
    answer_.impact = way ? impact_on(*way) : impact_between(bounds);
    if (!answer_.impact.empty()) return;
    if (beside_.period) answer_.period = period_of(energy_, answer_, bounds);
    if (!beside_.along) return;
    if (!way) {
      answer_.validity = no_minima(dynamics_.model(), "The motion is not periodic.");
      return;
    }
    answer_.validity = minima_along(
        way->turns_back ? libration_path(energy_, way->from, way->to) : rotation_path(energy_, x0_dot_),
        *way);
    note_singular_places(*way);
  }

  /// Between walls that give back all of the speed, or one and a turning point. False where it comes to none,
  /// or that is not known.
  [[nodiscard]] bool bounces(const MotionBounds& bounds, const std::string& name) {
    if (!beside_.impacts || dynamics_.model().parsed.impacts.empty()) return false;
    const auto walls = elastic_walls(dynamics_.model(), parameters_, y0_);
    if (!walls) return false;
    const auto low = end_of(bounds.down, walls->below, -1), high = end_of(bounds.up, walls->above, 1);
    if (!low || !high || !(low->is_wall || high->is_wall)) return false;
    answer_.walls.emplace();
    take_wall(*low, walls->below, answer_.walls->below, answer_.minimum, name);
    take_wall(*high, walls->above, answer_.walls->above, answer_.maximum, name);
    answer_.motion = MotionKind::libration;
    if (beside_.period) answer_.period = elastic_period(energy_, *low, *high);
    if (beside_.along)
      answer_.validity = no_minima(dynamics_.model(), "A wall turns the motion, which is not followed here.");
    return true;
  }

  void take_wall(const ElasticEnd& end, const std::optional<ElasticWall>& wall,
                 std::optional<ElasticWall>& taken, Finding& extremum, const std::string& name) {
    if (!end.is_wall) return;
    taken = wall;
    extremum = {wall->place.value(), wall->place.error(), ""};
    answer_.notes.push_back("At " + name + " = " + short_number(wall->place.value(), 10) + " the impact '" +
                            wall->event + "' turns the motion round, and takes nothing of its speed.");
  }

  /// Where the motion turns on one side; none where that is not known.
  [[nodiscard]] std::optional<ElasticEnd> end_of(const MotionBound& bound,
                                                 const std::optional<ElasticWall>& wall, int side) {
    using Kind = MotionBound::Kind;
    const bool turns = bound.kind == Kind::turning;
    if (!wall) return turns ? std::optional(ElasticEnd{Ball::of(bound.place), false}) : std::nullopt;
    if (!turns && bound.kind != Kind::unbounded) return std::nullopt;
    if (turns) {
      const Interval beyond = Interval(side) * (wall->place.interval() - bound.place);
      if (beyond.lower > 0) return ElasticEnd{Ball::of(bound.place), false};
      if (!(beyond.upper < 0)) return std::nullopt;
    }
    if (!(energy_.remaining(wall->place.interval()).lower > 0)) return std::nullopt;
    return ElasticEnd{wall->place, true};
  }

  [[nodiscard]] std::optional<PeriodicWay> way_of(const MotionBounds& bounds) const {
    if (answer_.motion == MotionKind::libration) return PeriodicWay{bounds.down.place, bounds.up.place, true};
    if (answer_.motion == MotionKind::rotation)
      return PeriodicWay{energy_.start(), energy_.start() + turn, false, std::copysign(1.0, x0_dot_)};
    return std::nullopt;
  }

  [[nodiscard]] std::string impact_on(const PeriodicWay& way) {
    if (!beside_.impacts || dynamics_.model().parsed.impacts.empty()) return "";
    const std::vector<Column> columns = impact_columns(dynamics_.model());
    if (std::string untold = impact_that_depends(columns, what_is_untold()); !untold.empty()) return untold;
    const auto values = dynamics_.columns(columns);
    EnclosedMotion motion = motion_along(way, *values);
    return impact_along(motion, columns);
  }

  /// What the way does not tell.
  [[nodiscard]] std::vector<Expression> what_is_untold() const {
    const Symbols& symbols = dynamics_.model().parsed.symbols;
    std::vector<Expression> untold = symbols.inputs.value;
    untold.push_back(symbols.t);
    for (const std::size_t i : problem_.original->reduction.ignored)
      untold.push_back(symbols.coordinates.value[i]);
    return untold;
  }

  /// Of a motion that does not come back, which may have any velocity.
  [[nodiscard]] std::string impact_between(const MotionBounds& bounds) const {
    if (!beside_.impacts || dynamics_.model().parsed.impacts.empty()) return "";
    const std::vector<Column> columns = impact_columns(dynamics_.model());
    if (std::string untold = impact_that_depends(columns, what_is_untold()); !untold.empty()) return untold;
    const auto end = [](const MotionBound& bound, double otherwise) {
      return bound.kind == MotionBound::Kind::turning ? bound.place : Interval(otherwise);
    };
    Box states(y0_.size(), Interval(-infinity, infinity));
    states[problem_.coordinate] = hull(end(bounds.down, -infinity), end(bounds.up, infinity));
    return impact_within(dynamics_, parameters_, states, columns);
  }

  [[nodiscard]] EnclosedMotion motion_along(const PeriodicWay& way, const CompiledFunction& values) {
    const auto momenta = std::span(problem_.constants).subspan(parameters_.size());
    return {energy_, way, values, dynamics_, problem_.original->reduction, parameters_, momenta, y0_};
  }

  [[nodiscard]] std::vector<ValidityMinimum> minima_along(const PhasePath& path,
                                                          const std::optional<PeriodicWay>& way) {
    const std::vector<Column> columns = validity_columns(dynamics_.model());
    if (columns.empty()) return {};
    if (way) {
      const auto values = dynamics_.columns(columns);
      EnclosedMotion motion = motion_along(*way, *values);
      std::vector<ValidityMinimum> proven = proven_minima(motion, columns.size());
      if (!proven.empty()) return proven;
    }
    return validity_minima(dynamics_, problem_.original->reduction, parameters_, answer_.momenta, y0_, path);
  }

  void note_singular_places(const PeriodicWay& way) {
    const Scene& scene = dynamics_.model().scene;
    if (scene.singular_where.empty()) return;
    std::vector<Column> columns;
    for (std::size_t i = 0; i < scene.singular_where.size(); ++i)
      columns.push_back({scene.singular_where[i].name, "", dynamics_.model().parsed.singular_where[i]});
    const auto values = dynamics_.columns(columns);
    EnclosedMotion motion = motion_along(way, *values);
    for (std::string& note : singular_places(scene, motion)) answer_.notes.push_back(std::move(note));
  }

  BesideExtrema beside_;
  const Dynamics& dynamics_;
  const EnergyProblem& problem_;
  const Reals &parameters_, &y0_;
  double x0_, x0_dot_;
  EnergyBalance energy_;
  TurningPoints answer_;
};

}  // namespace

TurningPoints turning_points(const Dynamics& dynamics, const Reals& parameters, const Reals& y0,
                             const BesideExtrema& beside) {
  refuse_missing_values(dynamics.model(), parameters, 0, y0);
  const EnergyProblem problem = energy_problem(dynamics, parameters, y0);
  return Question(dynamics, problem, parameters, y0, beside).answer();
}

}  // namespace qdot
