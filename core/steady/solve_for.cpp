#include "core/steady/solve_for.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/error.hpp"
#include "core/numerics/constants.hpp"
#include "core/steady/constrained_modes.hpp"
#include "core/steady/equilibria.hpp"
#include "core/steady/position_statics.hpp"
#include "core/steady/quadratic_roots.hpp"
#include "core/steady/rolling_modes.hpp"
#include "core/steady/solve_obstacles.hpp"
#include "core/steady/steady_rolling.hpp"

namespace qdot {
namespace {

/// A number that was written in decimals stands for its neighbours too.
Interval with_neighbours(double x) {
  return x == 0 ? Interval(0) : Interval(std::nextafter(x, -infinity), std::nextafter(x, infinity));
}

std::shared_ptr<const SteadyPolynomial> polynomial_of(const Dynamics& dynamics,
                                                      const PositionStatics& position,
                                                      std::span<const double> parameters,
                                                      const std::string& unknown) {
  if (position.surface)
    return std::make_shared<const SteadyPolynomial>(
        derive_steady_polynomial(position.surface->dynamics->model(), *position.statics,
                                 *position.on_surface->graph, position.on_surface->rest, unknown));
  return dynamics.derived<SteadyPolynomial>("solve for " + unknown, parameters, [&](const Statics& statics) {
    return derive_steady_polynomial(dynamics.model(), statics, *statics.reduction.graph, statics.rest,
                                    unknown);
  });
}

/// Kinks of the forces in x and u.
struct SolverKinks {
  bool move{};  ///< with u
  SmoothForces at_rest;
};

SolverKinks derive_solver_kinks(const Statics& statics, const std::string& unknown) {
  Graph graph(*statics.reduction.graph);
  const Expression u = graph.symbol(unknown);
  std::vector<Expression> rest;
  for (const Expression& g : statics.rest) rest.push_back(graph.adopt(g));
  return {!unfolded(rest, {&u, 1}).arguments.empty(), derive_smooth_forces(statics)};
}

std::shared_ptr<const SolverKinks> kinks_of(const Dynamics& dynamics, const PositionStatics& position,
                                            std::span<const double> parameters, const std::string& unknown) {
  if (position.surface)
    return std::make_shared<const SolverKinks>(derive_solver_kinks(*position.statics, unknown));
  return dynamics.derived<SolverKinks>("kinks beside " + unknown, parameters, [&](const Statics& statics) {
    return derive_solver_kinks(statics, unknown);
  });
}

class Solver {
 public:
  Solver(const Dynamics& dynamics, const Reals& parameters, const Reals& y, const std::string& unknown)
      : dynamics_(dynamics),
        scene_(dynamics.model().scene),
        unknown_(unknown),
        parameters_(with_unknown(scene_, parameters, unknown)),
        y_(y),
        position_(position_statics(dynamics, parameters_)),
        statics_(position_.statics),
        polynomial_(polynomial_of(dynamics, position_, parameters_, unknown)),
        kinks_(kinks_of(dynamics, position_, parameters_, unknown)) {
    for (const std::size_t i : statics_->reduction.kept) {
      if (is_multiplier(i)) {  // no force has it
        x_.emplace_back(0);
        near_.emplace_back(0);
        continue;
      }
      x_.push_back(Interval::literal(y_.exact(i)));
      near_.push_back(hull(x_.back(), with_neighbours(y_[i])));
    }
    constants_ = parameters_.as<Interval>();
    for (const std::size_t c : statics_->reduction.ignored) {
      constants_.push_back(Interval::literal(y_.exact(y_.size() / 2 + c)));
    }
    if (polynomial_->place < parameters_.size()) domain_ = scene_.parameters[polynomial_->place].domain;
  }

  Solution run() {
    result_.polynomial = polynomial_;
    Candidates found = candidates();
    keep(found.values);
    if (result_.values.empty() && !found.values.empty()) {
      found.obstacle = Obstacle::outside_domain;
      found.number = found.values[0].middle();
    }
    result_.reason = sentence(found, unknown_, at_position());
    if (kinks_->at_rest.kinks() > 0) return std::move(result_);  // ranges would end at kinks, too
    result_.ranges = solvable_ranges(*polynomial_, constants_, domain_, position_domain());
    return std::move(result_);
  }

 private:
  /// The multipliers' numbers come after those of the scene's coordinates.
  [[nodiscard]] bool is_multiplier(std::size_t i) const { return i >= y_.size() / 2; }

  [[nodiscard]] Domain position_domain() const {
    return scene_.coordinates[statics_->reduction.kept[0]].domain;
  }

  [[nodiscard]] std::string at_position() const {
    std::string text;
    for (const std::size_t j : polynomial_->needed) {
      const std::size_t i = statics_->reduction.kept[j];
      text += (text.empty() ? "" : ", ") + scene_.coordinates[i].name + " = " + short_number(y_[i], 6);
    }
    return text;
  }

  /// All candidates that satisfy every equation, before the domain is asked.
  [[nodiscard]] Candidates candidates() const {
    if (kinks_->move || is_at_kink()) return {Obstacle::at_kink, {}, "", 0};
    if (are_dependent(constants_)) return {Obstacle::dependent, {}, "", 0};
    const std::vector<Interval> c = coefficients(x_);
    const std::vector<Interval> near = coefficients(near_);
    std::optional<std::size_t> chosen;
    for (std::size_t k = 0; k < polynomial_->forces.size(); ++k) {
      const SteadyPolynomial::Force& force = polynomial_->forces[k];
      const bool matters = force.depends && !(force.degree && is_zero(c[3 * k + 1]) && is_zero(c[3 * k + 2]));
      if (matters) {
        if (!chosen) chosen = k;
      } else if (!near[3 * k].contains(0.0)) {
        return out_of_balance(force);
      }
    }
    if (!chosen) return {Obstacle::does_not_matter, {}, "", 0};
    Candidates found = polynomial_->forces[*chosen].degree
                           ? roots({&c[3 * *chosen], 3}, {&near[3 * *chosen], 3})
                           : searched(*chosen);
    std::erase_if(found.values, [&](const Interval& u) { return !satisfies_others(u, *chosen); });
    const bool depend = std::ranges::any_of(found.values, [&](const Interval& u) {
      std::vector<Interval> constants = constants_;
      constants[polynomial_->place] = u;
      return are_dependent(constants);
    });
    if (depend) return {Obstacle::dependent, {}, "", 0};
    if (found.values.empty() && found.obstacle == Obstacle::none) found.obstacle = Obstacle::no_common_value;
    return found;
  }

  [[nodiscard]] bool is_at_kink() const {
    std::vector<Interval> variables = near_, u(kinks_->at_rest.kinks());
    variables.resize(variables.size() + u.size(), Interval(-1, 1));
    TapeEvaluator<Interval>(kinks_->at_rest.arguments, constants_)(variables, u);
    return std::ranges::any_of(u, [](const Interval& argument) { return argument.contains(0.0); });
  }

  /// Of the constraints' slopes all determinants may vanish at the position.
  [[nodiscard]] bool are_dependent(std::span<const Interval> constants) const {
    if (!position_.on_surface) return false;
    std::vector<Interval> d(position_.on_surface->determinants.outputs());
    TapeEvaluator<Interval>(position_.on_surface->determinants, constants)(x_, d);
    return std::ranges::all_of(d, [](const Interval& one) { return one.contains(0.0); });
  }

  /// Of a force that no u makes vanish.
  [[nodiscard]] Candidates out_of_balance(const SteadyPolynomial::Force& force) const {
    const std::vector<std::size_t>& kept = statics_->reduction.kept;
    if (!position_.surface)
      return {Obstacle::not_in_balance, {}, scene_.coordinates[kept[force.equation]].name, 0};
    const auto sets = sets_of_forces(*position_.surface);
    if (force.equation >= sets.size())
      return {Obstacle::off_surface, {}, scene_.constraints[force.equation - sets.size()].name, 0};
    std::string names;
    for (const std::size_t k : sets[force.equation])
      names += (names.empty() ? "" : ", ") + scene_.coordinates[kept[k]].name;
    return {Obstacle::not_in_balance, {}, "What acts along " + names, 0};
  }

  [[nodiscard]] std::vector<Interval> coefficients(std::span<const Interval> x) const {
    std::vector<Interval> c(polynomial_->coefficients.outputs());
    TapeEvaluator<Interval>(polynomial_->coefficients, constants_)(x, c);
    return c;
  }

  [[nodiscard]] static Candidates roots(std::span<const Interval> c, std::span<const Interval> near) {
    QuadraticRoots found = quadratic_roots(c, near);
    using Outcome = QuadraticRoots::Outcome;
    static const std::map<Outcome, Obstacle> obstacles{{Outcome::found, Obstacle::none},
                                                       {Outcome::undefined, Obstacle::undefined},
                                                       {Outcome::at_infinity, Obstacle::no_finite_value},
                                                       {Outcome::not_real, Obstacle::no_real_value},
                                                       {Outcome::negative_square, Obstacle::negative_square}};
    return {obstacles.at(found.outcome), std::move(found.values), "", found.square};
  }

  /// A force that is no such polynomial: all its zeros along u.
  [[nodiscard]] Candidates searched(std::size_t k) const {
    TapeEvaluator<Interval> values(polynomial_->values, constants_);
    TapeEvaluator<Interval> derivatives(polynomial_->derivatives, constants_);
    std::vector<Interval> place = x_;
    place.emplace_back();
    std::vector<Interval> out(polynomial_->forces.size());
    const auto along = [&](TapeEvaluator<Interval>& function) {
      return [&](std::span<const Interval> u, std::span<Interval> value) {
        place.back() = u[0];
        function(place, out);
        value[0] = out[k];
      };
    };
    const Interval turn{-3.2, 3.2};  // a turn and a little more
    Interval region{std::max(domain_.lower, -largest_length), std::min(domain_.upper, largest_length)};
    if (polynomial_->u_turns) region = intersection(turn, region);
    Candidates found;
    const Isolation isolation = isolate_zeros({1, along(values), along(derivatives)}, {region});
    if (!isolation.complete || !isolation.undecided.empty()) return {Obstacle::not_decided, {}, "", 0};
    for (const IsolatedZero& zero : isolation.zeros) {
      const Interval u = polynomial_->u_turns ? reduced_angle(zero.enclosure[0]) : zero.enclosure[0];
      const auto is_same = [&](const Interval& other) { return !is_empty(intersection(other, u)); };
      if (std::ranges::none_of(found.values, is_same)) found.values.push_back(u);
    }
    if (found.values.empty()) found.obstacle = Obstacle::none_in_domain;
    return found;
  }

  [[nodiscard]] bool satisfies_others(const Interval& u, std::size_t chosen) const {
    std::vector<Interval> place = near_;
    place.push_back(u);
    std::vector<Interval> out(polynomial_->forces.size());
    TapeEvaluator<Interval>(polynomial_->values, constants_)(place, out);
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (k != chosen && !out[k].contains(0.0)) return false;
    }
    return true;
  }

  [[nodiscard]] bool is_allowed(const Interval& u) const {
    if (domain_.contains(representative(u))) return true;
    const Interval inside = intersection(u, {domain_.lower, domain_.upper});
    return !is_empty(inside) && inside.width() > 0;
  }

  void keep(const std::vector<Interval>& found) {
    for (const Interval& u : found) {
      if (is_allowed(u) && u.is_finite()) result_.values.push_back(solved(u));
    }
    std::sort(result_.values.begin(), result_.values.end(), [](const SolvedValue& a, const SolvedValue& b) {
      if ((a.value >= 0) != (b.value >= 0)) return a.value >= 0;
      return std::abs(a.value) < std::abs(b.value);
    });
  }

  SolvedValue solved(const Interval& u) {
    SolvedValue result;
    result.value = representative(u);
    if (!domain_.contains(result.value))
      result.value = intersection(u, {domain_.lower, domain_.upper}).middle();
    result.error = distance_bound(result.value, u);
    Reals parameters = parameters_;
    Reals y = y_;
    for (const std::size_t i : statics_->reduction.kept) {
      if (!is_multiplier(i)) y.set(y.size() / 2 + i, 0);
    }
    if (polynomial_->place < parameters.size()) {
      parameters.set(polynomial_->place, result.value);
    } else {
      const std::size_t c = statics_->reduction.ignored[polynomial_->place - parameters.size()];
      y.set(y.size() / 2 + c, result.value);
    }
    if (position_.surface) {
      const std::size_t place = polynomial_->place;
      const Real known_to{result.value, 0, result.error};
      if (place < parameters.size()) {
        parameters.set(place, known_to);
      } else {
        y.set(y.size() / 2 + statics_->reduction.ignored[place - parameters.size()], known_to);
      }
      result.stability = on_surface(parameters, y, u);
      return result;
    }
    SteadyProblem problem = steady_problem(dynamics_, parameters, y);
    enclose(problem.constants, u);
    result.stability = StabilityAnalysis(dynamics_, problem).at(x_of(problem));
    return result;
  }

  [[nodiscard]] SteadyStability on_surface(const Reals& parameters, const Reals& y, const Interval& u) const {
    const std::vector<double> state(y.begin(), y.end());
    SteadyStability result;
    try {
      if (has_constraint_in_velocities(dynamics_.model())) {
        const Modes modes = rolling_modes(dynamics_, parameters, y);
        result.stability = modes.stability;
        result.undecided = modes.undecided;
        return result;
      }
      const SurfaceStatics whole = surface_statics(dynamics_, parameters);
      std::vector<Interval> constants;
      for (const Ball& c : constants_on_surface(whole, dynamics_, parameters, y))
        constants.push_back(c.interval());
      enclose(constants, u);
      std::vector<Ball> balls;
      for (const Interval& c : constants) balls.push_back(Ball::of(c));
      Box q;
      for (std::size_t k = 0; k < whole.coordinates; ++k)
        q.push_back(Interval::literal(y.exact(whole.statics->reduction.kept[k])));
      return surface_modes_at(whole, balls, q, state).stability;
    } catch (const Error& error) {
      result.undecided = error.what();
    }
    return result;
  }

  /// The unknown and the momenta are only known to lie in intervals. What vanishes does so exactly.
  void enclose(std::vector<Interval>& of_problem, const Interval& u) const {
    std::vector<Interval> constants = constants_;
    constants[polynomial_->place] = u;
    std::vector<Interval> momenta(polynomial_->momenta.outputs());
    TapeEvaluator<Interval>(polynomial_->momenta, constants)(x_, momenta);
    const std::size_t parameters = parameters_.size();
    if (polynomial_->place < parameters) of_problem[polynomial_->place] = u;
    if (of_problem.size() != parameters + momenta.size()) return;
    for (std::size_t k = 0; k < momenta.size(); ++k) {
      if (!is_zero(of_problem[parameters + k])) of_problem[parameters + k] = momenta[k];
    }
  }

  /// Where the value vanishes, other coordinates may be ignorable.
  [[nodiscard]] Box x_of(const SteadyProblem& problem) const {
    Box x;
    for (const std::size_t i : problem.statics->reduction.kept) x.push_back(Interval::literal(y_.exact(i)));
    return x;
  }

  const Dynamics& dynamics_;
  const Scene& scene_;
  std::string unknown_;
  Reals parameters_, y_;
  PositionStatics position_;
  std::shared_ptr<const Statics> statics_;
  std::shared_ptr<const SteadyPolynomial> polynomial_;
  std::shared_ptr<const SolverKinks> kinks_;
  std::vector<Interval> x_, near_, constants_;
  Domain domain_;
  Solution result_;
};

}  // namespace

std::vector<std::string> solvable_names(const Dynamics& dynamics, std::span<const double> parameters) {
  const Scene& scene = dynamics.model().scene;
  std::vector<std::string> names;
  for (const Parameter& p : scene.parameters) names.push_back(p.name);
  const PositionStatics position = position_statics(dynamics, parameters);
  for (const std::size_t c : position.statics->reduction.ignored) {
    names.push_back(scene.coordinates[c].name + "_dot");
  }
  return names;
}

std::vector<std::size_t> needed_coordinates(const Dynamics& dynamics, const Reals& parameters,
                                            const std::string& unknown) {
  const Reals with = with_unknown(dynamics.model().scene, parameters, unknown);
  const PositionStatics position = position_statics(dynamics, with);
  const auto polynomial = polynomial_of(dynamics, position, with, unknown);
  std::vector<std::size_t> needed;
  for (const std::size_t j : polynomial->needed) {
    needed.push_back(position.statics->reduction.kept[j]);
  }
  return needed;
}

Solution solve_for(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                   const std::string& unknown) {
  return Solver(dynamics, parameters, y, unknown).run();
}

}  // namespace qdot
