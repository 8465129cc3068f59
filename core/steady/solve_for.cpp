#include "core/steady/solve_for.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/base/error.hpp"
#include "core/numerics/constants.hpp"
#include "core/steady/equilibria.hpp"

namespace qdot {
namespace {

std::string written(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

bool is_zero(const Interval& x) { return x.lower == 0 && x.upper == 0; }

/// A number that was written in decimals stands for its neighbours too.
Interval with_neighbours(double x) {
  return x == 0 ? Interval(0) : Interval(std::nextafter(x, -infinity), std::nextafter(x, infinity));
}

/// The parameters with one that stands in for the unknown: it must not count as vanishing.
std::vector<double> with_unknown(const Scene& scene, std::span<const double> parameters,
                                 const std::string& unknown) {
  std::vector<double> result(parameters.begin(), parameters.end());
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (scene.parameters[i].name == unknown) result[i] = 1;
  }
  return result;
}

std::shared_ptr<const SteadyPolynomial> polynomial_of(const Dynamics& dynamics,
                                                      std::span<const double> parameters,
                                                      const std::string& unknown) {
  return dynamics.derived<SteadyPolynomial>("solve for " + unknown, parameters, [&](const Statics& statics) {
    return derive_steady_polynomial(dynamics.model(), statics, unknown);
  });
}

class Solver {
 public:
  Solver(const Dynamics& dynamics, std::span<const double> parameters, std::span<const double> y,
         const std::string& unknown)
      : dynamics_(dynamics),
        scene_(dynamics.model().scene),
        unknown_(unknown),
        parameters_(with_unknown(scene_, parameters, unknown)),
        y_(y.begin(), y.end()),
        statics_(dynamics.statics(parameters_)),
        polynomial_(polynomial_of(dynamics, parameters_, unknown)) {
    for (const std::size_t i : statics_->reduction.kept) {
      x_.emplace_back(y_[i]);
      near_.push_back(with_neighbours(y_[i]));
    }
    constants_.assign(parameters_.begin(), parameters_.end());
    for (const std::size_t c : statics_->reduction.ignored) constants_.emplace_back(y_[y_.size() / 2 + c]);
    if (polynomial_->place < parameters_.size()) domain_ = scene_.parameters[polynomial_->place].domain;
  }

  Solution run() {
    const auto solved = solve();
    if (solved) keep(*solved);
    result_.ranges = solvable_ranges(*polynomial_, constants_, domain_, position_domain());
    return std::move(result_);
  }

 private:
  [[nodiscard]] Domain position_domain() const {
    return scene_.coordinates[statics_->reduction.kept[0]].domain;
  }

  [[nodiscard]] std::string at_position() const {
    std::string text;
    for (const std::size_t j : polynomial_->needed) {
      const std::size_t i = statics_->reduction.kept[j];
      text += (text.empty() ? "" : ", ") + scene_.coordinates[i].name + " = " + written(y_[i]);
    }
    return text;
  }

  /// All candidates that satisfy every equation, before the domain is asked; none with a reason.
  std::optional<std::vector<Interval>> solve() {
    const std::vector<Interval> c = coefficients(x_);
    const std::vector<Interval> near = coefficients(near_);
    std::optional<std::size_t> chosen;
    for (std::size_t k = 0; k < polynomial_->forces.size(); ++k) {
      const SteadyPolynomial::Force& force = polynomial_->forces[k];
      const std::span<const Interval> here(&c[3 * k], 3);
      const bool matters = force.depends && !(force.degree && is_zero(here[1]) && is_zero(here[2]));
      if (matters) {
        if (!chosen) chosen = k;
      } else if (!near[3 * k].contains(0.0)) {
        return none(coordinate_of(force) + " is not in balance at " + at_position() + ", whatever " +
                    unknown_ + " is.");
      }
    }
    if (!chosen) {
      return none("Every value does: " + unknown_ + " does not matter at " + at_position() + ".");
    }
    std::vector<Interval> found = polynomial_->forces[*chosen].degree
                                      ? roots({&c[3 * *chosen], 3}, {&near[3 * *chosen], 3})
                                      : searched(*chosen);
    std::erase_if(found, [&](const Interval& u) { return !satisfies_others(u, *chosen); });
    if (found.empty() && result_.reason.empty()) {
      return none("No single value of " + unknown_ + " balances all forces at " + at_position() + ".");
    }
    return found;
  }

  [[nodiscard]] std::string coordinate_of(const SteadyPolynomial::Force& force) const {
    return scene_.coordinates[statics_->reduction.kept[force.equation]].name;
  }

  std::nullopt_t none(std::string reason) {
    result_.reason = std::move(reason);
    return std::nullopt;
  }

  [[nodiscard]] std::vector<Interval> coefficients(std::span<const Interval> x) const {
    std::vector<Interval> c(polynomial_->coefficients.outputs());
    TapeEvaluator<Interval>(polynomial_->coefficients, constants_)(x, c);
    return c;
  }

  /// c0 + c1 u + c2 u^2 = 0. `near`: the coefficients for all positions that the given one may stand for.
  std::vector<Interval> roots(std::span<const Interval> c, std::span<const Interval> near) {
    for (const Interval& coefficient : c) {
      if (coefficient.is_finite()) continue;
      none("The forces have no finite value at " + at_position() + ".");
      return {};
    }
    if (is_zero(c[2])) return linear_root(c, near);
    if (near[2].contains(0.0)) return no_finite_value();
    if (is_zero(c[1])) return opposite_roots(c);
    const Interval discriminant = square(c[1]) - Interval(4) * c[2] * c[0];
    if (discriminant.upper < 0) return no_real_value();
    const Interval root = sqrt(Interval(std::max(discriminant.lower, 0.0), discriminant.upper));
    if (discriminant.lower <= 0 || c[1].contains(0.0)) {
      return {(-c[1] - root) / (Interval(2) * c[2]), (-c[1] + root) / (Interval(2) * c[2])};
    }
    const Interval q = (c[1].lower > 0 ? -c[1] - root : -c[1] + root) / Interval(2);  // no cancellation
    return {q / c[2], c[0] / q};
  }

  std::vector<Interval> linear_root(std::span<const Interval> c, std::span<const Interval> near) {
    return near[1].contains(0.0) ? no_finite_value() : std::vector<Interval>{-c[0] / c[1]};
  }

  std::vector<Interval> opposite_roots(std::span<const Interval> c) {
    const Interval w = -c[0] / c[2];
    if (w.upper < 0) {
      none("No real " + unknown_ + " holds " + at_position() + ": " + unknown_ + "^2 would have to be " +
           written(w.middle()) + ".");
      return {};
    }
    const Interval root = sqrt(Interval(std::max(w.lower, 0.0), w.upper));
    if (root.lower == 0) return {hull(root, -root)};  // to within rounding one value, 0
    return {root, -root};
  }

  std::vector<Interval> no_real_value() {
    none("No real " + unknown_ + " holds " + at_position() + ".");
    return {};
  }
  std::vector<Interval> no_finite_value() {
    none("No finite " + unknown_ + " holds " + at_position() + ": to within rounding it is a position that " +
         unknown_ + " approaches as it grows without bound.");
    return {};
  }

  /// A force that is no such polynomial: all its zeros along u.
  std::vector<Interval> searched(std::size_t k) {
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
    const Isolation isolation = isolate_zeros({1, along(values), along(derivatives)}, {region});
    std::vector<Interval> found;
    for (const IsolatedZero& zero : isolation.zeros) {
      const Interval u = polynomial_->u_turns ? reduced_angle(zero.enclosure[0]) : zero.enclosure[0];
      const bool known = std::any_of(found.begin(), found.end(), [&](const Interval& other) {
        return !is_empty(intersection(other, u));
      });
      if (!known) found.push_back(u);
    }
    if (found.empty()) none("No " + unknown_ + " in its domain holds " + at_position() + ".");
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
    if (!result_.values.empty() || found.empty()) return;
    result_.reason =
        unknown_ + " would have to be " + written(found[0].middle()) + ", which is outside its domain.";
  }

  SolvedValue solved(const Interval& u) {
    SolvedValue result;
    result.value = representative(u);
    if (!domain_.contains(result.value))
      result.value = intersection(u, {domain_.lower, domain_.upper}).middle();
    result.error = distance_bound(result.value, u);
    std::vector<double> parameters = parameters_;
    std::vector<double> y = y_;
    for (const std::size_t i : statics_->reduction.kept) y[y.size() / 2 + i] = 0;
    if (polynomial_->place < parameters.size()) {
      parameters[polynomial_->place] = result.value;
    } else {
      const std::size_t c = statics_->reduction.ignored[polynomial_->place - parameters.size()];
      y[y.size() / 2 + c] = result.value;
    }
    SteadyProblem problem = steady_problem(dynamics_, parameters, y);
    enclose(problem, u);
    result.stability = StabilityAnalysis(dynamics_, problem).at(x_of(problem));
    return result;
  }

  /// The unknown and the momenta are only known to lie in intervals. What vanishes does so exactly.
  void enclose(SteadyProblem& problem, const Interval& u) const {
    std::vector<Interval> constants = constants_;
    constants[polynomial_->place] = u;
    std::vector<Interval> momenta(polynomial_->momenta.outputs());
    TapeEvaluator<Interval>(polynomial_->momenta, constants)(x_, momenta);
    const std::size_t parameters = parameters_.size();
    if (polynomial_->place < parameters) problem.constants[polynomial_->place] = u;
    if (problem.constants.size() != parameters + momenta.size()) return;
    for (std::size_t k = 0; k < momenta.size(); ++k) {
      if (!is_zero(problem.constants[parameters + k])) problem.constants[parameters + k] = momenta[k];
    }
  }

  /// Where the value vanishes, other coordinates may be ignorable.
  [[nodiscard]] Box x_of(const SteadyProblem& problem) const {
    Box x;
    for (const std::size_t i : problem.statics->reduction.kept) x.emplace_back(y_[i]);
    return x;
  }

  const Dynamics& dynamics_;
  const Scene& scene_;
  std::string unknown_;
  std::vector<double> parameters_, y_;
  std::shared_ptr<const Statics> statics_;
  std::shared_ptr<const SteadyPolynomial> polynomial_;
  std::vector<Interval> x_, near_, constants_;
  Domain domain_;
  Solution result_;
};

}  // namespace

std::vector<std::string> solvable_names(const Dynamics& dynamics, std::span<const double> parameters) {
  const Scene& scene = dynamics.model().scene;
  std::vector<std::string> names;
  for (const Parameter& p : scene.parameters) names.push_back(p.name);
  for (const std::size_t c : dynamics.statics(parameters)->reduction.ignored) {
    names.push_back(scene.coordinates[c].name + "_dot");
  }
  return names;
}

std::vector<std::size_t> needed_coordinates(const Dynamics& dynamics, std::span<const double> parameters,
                                            const std::string& unknown) {
  const std::vector<double> with = with_unknown(dynamics.model().scene, parameters, unknown);
  const auto statics = dynamics.statics(with);
  std::vector<std::size_t> needed;
  for (const std::size_t j : polynomial_of(dynamics, with, unknown)->needed) {
    needed.push_back(statics->reduction.kept[j]);
  }
  return needed;
}

Solution solve_for(const Dynamics& dynamics, std::span<const double> parameters, std::span<const double> y,
                   const std::string& unknown) {
  return Solver(dynamics, parameters, y, unknown).run();
}

}  // namespace qdot
