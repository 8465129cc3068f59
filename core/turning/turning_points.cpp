#include "core/turning/turning_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/expr/simplify.hpp"
#include "core/numerics/constants.hpp"
#include "core/turning/oscillation_period.hpp"
#include "core/turning/turning_search.hpp"

namespace qdot {
namespace {

/// u contains x only as x times a whole number, with something added.
bool turns_whole(const Expression& u, const Expression& x) {
  const auto whole_multiple = [&](const Expression& term) {
    const auto* product = std::get_if<Product>(&term.node());
    if (product == nullptr) return term == x;
    return product->coefficient.is_integer() && product->factors == std::vector<NodeId>{x.id()};
  };
  if (whole_multiple(u)) return true;
  const auto* sum = std::get_if<Sum>(&u.node());
  return sum != nullptr && std::all_of(sum->terms.begin(), sum->terms.end(), [&](NodeId id) {
           const Expression term(u.graph(), id);
           return !depends_on(term, x) || whole_multiple(term);
         });
}

/// e is the same at x and at x + 2 pi, seen from its form: x stands in sin, cos and tan of whole multiples.
bool is_periodic(const Expression& e, const Expression& x) {
  if (!depends_on(e, x)) return true;
  if (const auto* call = std::get_if<Call>(&e.node())) {
    const bool circular =
        call->function == Function::sin || call->function == Function::cos || call->function == Function::tan;
    const Expression argument(e.graph(), call->argument);
    if (circular && turns_whole(argument, x)) return true;
    return is_periodic(argument, x);
  }
  const std::vector<NodeId> below = children(e.node());
  return !below.empty() && std::all_of(below.begin(), below.end(),
                                       [&](NodeId id) { return is_periodic(Expression(e.graph(), id), x); });
}

/// The parameters and the momenta of the ignored coordinates, these with the rounding of their evaluation.
std::vector<Ball> enclosed_constants(const Dynamics& dynamics, const Statics& statics,
                                     std::span<const double> parameters, std::span<const double> y) {
  std::vector<Ball> constants(parameters.begin(), parameters.end());
  if (statics.reduction.ignored.empty()) return constants;
  const std::vector<Column> all = momentum_columns(dynamics.model());
  std::vector<Column> columns;
  for (const std::size_t c : statics.reduction.ignored) columns.push_back(all[c]);
  const auto function = dynamics.columns(columns);
  const std::vector<Ball> state(y.begin(), y.end());
  std::vector<Ball> momenta(columns.size());
  TapeEvaluator<Ball>(*function, constants)(state, momenta);
  constants.insert(constants.end(), momenta.begin(), momenta.end());
  return constants;
}

/// The same without the momenta that are exactly 0: nothing is divided by what they were multiplied with.
Statics without_vanishing_momenta(const Statics& statics, std::span<const Ball> constants) {
  Reduction own = statics.reduction;
  own.graph = std::make_shared<Graph>(*statics.reduction.graph);
  Graph& graph = *own.graph;
  std::vector<Replacement> zeros;
  for (std::size_t i = constants.size() - own.ignored.size(); i < constants.size(); ++i) {
    if (constants[i].is_zero()) zeros.emplace_back(graph.adopt(own.constants[i]), graph.number(0));
  }
  const auto reduced = [&](const Expression& e) { return simplify(substitute(graph.adopt(e), zeros)); };
  const Expression x = graph.adopt(own.x[0]);
  own.x = {x};
  own.x_dot = {graph.adopt(own.x_dot[0])};
  own.x_ddot = {graph.adopt(own.x_ddot[0])};
  const Expression potential = reduced(Number(-1) * at_rest(own, graph.adopt(own.routhian)));
  const Expression force = simplify(differentiate(potential, x));
  const Expression inertia =
      reduced(at_rest(own, differentiate(graph.adopt(own.equations[0]), own.x_ddot[0])));
  const auto compiled = [&](const Expression& e) { return compiled_at_rest(own, graph, {&e, 1}); };
  Statics result;
  result.forces = compiled(force);
  result.stiffness = compiled(simplify(differentiate(force, x)));
  result.inertia = compiled(inertia);
  result.potential = compiled(potential);
  result.reduction = std::move(own);
  return result;
}

class Question {
 public:
  Question(const Dynamics& dynamics, const Statics& statics, const Statics& original,
           std::span<const Ball> constants, std::span<const double> parameters, std::span<const double> y0)
      : dynamics_(dynamics),
        original_(original),
        parameters_(parameters),
        y0_(y0),
        coordinate_(statics.reduction.kept[0]),
        x0_(y0[coordinate_]),
        x0_dot_(y0[y0.size() / 2 + coordinate_]),
        energy_(statics, constants, x0_, x0_dot_) {
    const Coordinate& q = dynamics.model().scene.coordinates[coordinate_];
    range_.domain = q.domain;
    const bool bounded = std::isfinite(q.domain.lower) || std::isfinite(q.domain.upper);
    if (q.unit == "rad" && !bounded && is_periodic(original.reduction.routhian, original.reduction.x[0])) {
      range_.period = std::nextafter(2 * std::numbers::pi, infinity);
    }
    for (std::size_t i = parameters.size(); i < constants.size(); ++i)
      answer_.momenta.push_back(constants[i].value());
  }

  TurningPoints answer() {
    answer_.coordinate = coordinate_;
    check_start();
    const Interval h = energy_.kinetic_energy() + energy_.potential(x0_);
    answer_.energy = {h.middle(), h.radius(), ""};
    if (energy_.starts_at_rest() && !departs()) {
      stay();
    } else {
      move();
    }
    note_singularities();
    return std::move(answer_);
  }

 private:
  void check_start() {
    const Interval inertia = energy_.inertia(x0_);
    if (!(inertia.lower > 0) || !energy_.potential(x0_).is_finite() ||
        !energy_.potential_rate(x0_).is_finite() || !std::isfinite(energy_.kinetic_energy().upper)) {
      throw Error(ErrorCode::invalid_state,
                  "In the initial state the effective potential or the inertia of " + name() +
                      " has no finite positive value.");
    }
  }

  [[nodiscard]] const std::string& name() const {
    return dynamics_.model().scene.coordinates[coordinate_].name;
  }

  /// Where the force at rest points, if it has a sign and x0 is not the double nearest to an equilibrium.
  [[nodiscard]] bool departs() {
    const Interval g = energy_.potential_rate(x0_);
    if (g.contains(0.0)) return false;
    const Interval near(std::nextafter(x0_, -infinity), std::nextafter(x0_, infinity));
    const Interval k = energy_.stiffness(near);
    if (k.contains(0.0)) return true;
    return is_empty(intersection(Interval(x0_) - g / k, near));
  }

  /// Rest in an equilibrium, as far as the numbers tell: it is within g/K of x0.
  void stay() {
    const Interval g = energy_.potential_rate(x0_);
    double error = 0;
    const Interval k = energy_.stiffness(x0_);
    if (g.magnitude() > 0) {
      constexpr double neighbourhood = 1e-6;
      const double reach = neighbourhood * (1 + std::abs(x0_));
      const Interval near = energy_.stiffness({x0_ - reach, x0_ + reach});
      error = 2 * (g / near).magnitude();
      if (near.contains(0.0) || !(error < reach)) return undecided_rest();
    }
    answer_.maximum = {x0_, error, ""};
    answer_.minimum = {x0_, error, ""};
    answer_.motion = MotionKind::equilibrium;
    answer_.initial = InitialPlace::equilibrium;
    answer_.stability = k.lower > 0 ? "stable" : k.upper < 0 ? "unstable" : "neutral";
    answer_.period = {std::nullopt, 0, "The system stays at rest."};
    if (k.upper < 0 && error > 0) {
      answer_.notes.push_back("The equilibrium is unstable, and " + name() +
                              " is the nearest number to it: the least push carries the system away.");
    }
    find_validity([this](double) { return std::pair(x0_, 0.0); });
  }

  void undecided_rest() {
    const std::string why = "In double precision the force on " + name() +
                            " cannot be told from zero here, so neither can rest from a slow motion.";
    answer_.maximum.reason = answer_.minimum.reason = answer_.motion_reason = answer_.period.reason = why;
  }

  void move() {
    MotionBound up{MotionBound::Kind::turning, x0_};
    MotionBound down = up;
    const double pull = energy_.potential_rate(x0_).middle();
    const bool at_rest = energy_.starts_at_rest();
    if (!at_rest || pull < 0) up = search(Direction::up);
    if (!at_rest || pull > 0) down = search(Direction::down);
    if (at_rest) answer_.initial = pull < 0 ? InitialPlace::minimum : InitialPlace::maximum;
    answer_.maximum = extremum(up);
    answer_.minimum = extremum(down);
    classify(down.kind, up.kind);
    find_period(down.place, up.place);
    find_validity(down.place, up.place);
  }

  MotionBound search(Direction direction) {
    MotionBound bound = TurningSearch(energy_, range_, direction).run();
    if (bound.kind == MotionBound::Kind::turning) sharpen(bound.place);
    return bound;
  }

  /// One more step of Newton's with twice the digits.
  void sharpen(Interval& place) {
    const double m = place.middle();
    const Interval slope = energy_.potential_rate(place);
    const Interval next = intersection(Interval(m) + energy_.remaining_sharply(m) / slope, place);
    if (!is_empty(next)) place = next;
  }

  [[nodiscard]] Finding extremum(const MotionBound& bound) const {
    const double place = bound.place.middle();
    switch (bound.kind) {
      case MotionBound::Kind::turning:
        return {place, bound.place.radius(), ""};
      case MotionBound::Kind::asymptote:
        return {
            place, bound.place.radius(),
            "The energy is that of a maximum of the effective potential there, as far as double precision "
            "tells: it is approached, not reached."};
      case MotionBound::Kind::full_turn:
        return {{}, 0, name() + " never turns: the kinetic energy stays positive over a whole turn."};
      case MotionBound::Kind::unbounded:
        return {{}, 0, name() + " never turns on this side: the kinetic energy stays positive all the way."};
      case MotionBound::Kind::domain_end:
        return {{},
                0,
                "The motion reaches the end of the range in which " + name() + " describes a configuration."};
      case MotionBound::Kind::unresolved:
        break;
    }
    return {{},
            0,
            "Beyond " + std::to_string(place) +
                " double precision cannot tell whether the motion turns; the potential is singular or almost "
                "flat there."};
  }

  void classify(MotionBound::Kind down, MotionBound::Kind up) {
    using Kind = MotionBound::Kind;
    const auto either = [&](Kind kind) { return down == kind || up == kind; };
    if (either(Kind::unresolved)) {
      answer_.motion_reason = down == Kind::unresolved ? answer_.minimum.reason : answer_.maximum.reason;
    } else if (either(Kind::asymptote)) {
      answer_.motion = MotionKind::separatrix;
    } else if (either(Kind::domain_end)) {
      answer_.motion_reason = down == Kind::domain_end ? answer_.minimum.reason : answer_.maximum.reason;
    } else if (either(Kind::full_turn)) {
      answer_.motion = MotionKind::rotation;
    } else if (either(Kind::unbounded)) {
      answer_.motion = MotionKind::unbounded;
    } else {
      answer_.motion = MotionKind::libration;
    }
  }

  void find_period(const Interval& a, const Interval& b) {
    if (!answer_.motion) {
      answer_.period.reason = answer_.motion_reason;
    } else if (answer_.motion == MotionKind::libration) {
      answer_.period = libration_period(energy_, a, b);
    } else if (answer_.motion == MotionKind::rotation) {
      answer_.period = rotation_period(energy_);
    } else {
      answer_.period.reason = answer_.motion == MotionKind::separatrix
                                  ? "The motion takes for ever to reach the maximum of the potential."
                                  : "The motion does not come back.";
    }
  }

  void find_validity(const Interval& a, const Interval& b) {
    if (answer_.motion == MotionKind::libration) {
      const double middle = a.middle() / 2 + b.middle() / 2;
      const double half = b.middle() / 2 - a.middle() / 2;
      find_validity([&, middle, half](double phase) {
        const double sine = evaluate(Function::sin, phase);
        const double x = middle + half * evaluate(Function::cos, phase);
        return std::pair(x, -half * sine * phase_rate(a, b, x));
      });
    } else if (answer_.motion == MotionKind::rotation) {
      find_validity([this](double phase) {
        const double x = x0_ + phase;
        const double speed = std::sqrt(2 * energy_.remaining(x).middle() / energy_.inertia(x).middle());
        return std::pair(x, std::copysign(speed, x0_dot_));
      });
    } else {
      for (std::size_t i = 0; i < dynamics_.model().validity.size(); ++i) {
        answer_.validity.push_back({.condition = i, .value = {}, .reason = "The motion is not periodic."});
      }
    }
  }

  /// x' over half sin(phase), sqrt(2 Q/A) of oscillation_period.hpp.
  [[nodiscard]] double phase_rate(const Interval& a, const Interval& b, double x) {
    const bool near_a = x - a.middle() < b.middle() - x;
    const Interval q = near_a ? -energy_.potential_slope(a, x) / (b - Interval(x))
                              : energy_.potential_slope(b, x) / (Interval(x) - a);
    return std::sqrt(std::max(0.0, 2 * q.middle() / energy_.inertia(x).middle()));
  }

  void find_validity(const PhasePath& path) {
    answer_.validity =
        validity_minima(dynamics_, original_.reduction, parameters_, answer_.momenta, y0_, path);
  }

  /// The energy integral knows nothing of places where other coordinates lose their meaning.
  void note_singularities() {
    const Model& model = dynamics_.model();
    if (model.scene.singular_where.empty() || !answer_.minimum.value || !answer_.maximum.value) return;
    std::vector<Column> columns;
    for (std::size_t i = 0; i < model.scene.singular_where.size(); ++i)
      columns.push_back({model.scene.singular_where[i].name, "", model.parsed.singular_where[i]});
    const auto function = dynamics_.columns(columns);
    Workspace workspace = function->bind(parameters_);
    std::vector<double> y(y0_.begin(), y0_.end()), values(columns.size());
    std::vector<int> signs(columns.size());
    constexpr int pieces = 64;
    for (int k = 0; k <= pieces; ++k) {
      y[coordinate_] =
          *answer_.minimum.value + (*answer_.maximum.value - *answer_.minimum.value) * k / pieces;
      if (function->evaluate(0, y, workspace, values) != Evaluation::ok) return;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const int sign = (values[i] > 0) - (values[i] < 0);
        if (signs[i] != 0 && signs[i] != 2 && sign != signs[i]) {
          answer_.notes.push_back("On its way the motion passes a singular place: " +
                                  model.scene.singular_where[i].message);
          signs[i] = 2;
        } else if (signs[i] != 2) {
          signs[i] = sign;
        }
      }
    }
  }

  const Dynamics& dynamics_;
  const Statics& original_;
  std::span<const double> parameters_;
  std::span<const double> y0_;
  std::size_t coordinate_;
  double x0_, x0_dot_;
  EnergyBalance energy_;
  Range range_;
  TurningPoints answer_;
};

}  // namespace

std::string why_not_by_energy(const Dynamics& dynamics, std::span<const double> parameters,
                              std::size_t coordinate) {
  std::shared_ptr<const Statics> statics;
  try {
    statics = dynamics.statics(parameters);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_applicable) throw;
    return "the time enters the equations of motion";
  }
  const Reduction& reduction = statics->reduction;
  if (reduction.degrees_of_freedom() != 1) return "more than one coordinate is left after the ignorable ones";
  if (reduction.kept[0] != coordinate) return "the coordinate is ignorable";
  if (!statics->potential) return "the forces do not leave the energy integral constant";
  if (!statics->quadratic) return "the energy is not quadratic in the velocity";
  return "";
}

TurningPoints turning_points(const Dynamics& dynamics, std::span<const double> parameters,
                             std::span<const double> y0) {
  const std::shared_ptr<const Statics> statics = dynamics.statics(parameters);
  const std::string why_not = why_not_by_energy(dynamics, parameters, statics->reduction.kept[0]);
  if (!why_not.empty()) {
    throw Error(ErrorCode::not_applicable,
                "There are no turning points without following the motion: " + why_not + ".");
  }
  const std::vector<Ball> constants = enclosed_constants(dynamics, *statics, parameters, y0);
  const bool vanishing = std::any_of(constants.begin() + static_cast<std::ptrdiff_t>(parameters.size()),
                                     constants.end(), [](const Ball& p) { return p.is_zero(); });
  if (!vanishing) return Question(dynamics, *statics, *statics, constants, parameters, y0).answer();
  const Statics reduced = without_vanishing_momenta(*statics, constants);
  return Question(dynamics, reduced, *statics, constants, parameters, y0).answer();
}

}  // namespace qdot
