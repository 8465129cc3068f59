#include "core/closed/critical_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/assumed_signs.hpp"
#include "core/closed/best_form.hpp"
#include "core/closed/equal_parts.hpp"
#include "core/closed/exact_roots.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/closed/place_search.hpp"
#include "core/closed/trial.hpp"
#include "core/steady/followed_momenta.hpp"
#include "core/steady/growing_oscillations.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {
namespace {

class CriticalForm {
 public:
  CriticalForm(const Dynamics& dynamics, const Statics& statics, const Reals& parameters, std::size_t index,
               const WrittenTexts& written, const CriticalValue& critical)
      : motions_(linear_motions(statics.reduction, dynamics.model().scene)),
        values_(dynamics.model(), motions_.graph, written, parameters, index),
        p_(values_.symbols()[index]),
        critical_(critical) {
    std::vector<Interval> near;
    for (std::size_t i = 0; i < critical.y.size() / 2; ++i)
      near.emplace_back(critical.y[i] - critical.errors[i], critical.y[i] + critical.errors[i]);
    problem_ = place_problem(motions_, values_, those_of(near, motions_.moving));
  }

  std::optional<ClosedForm> form() {
    std::optional<ClosedForm> found = found_form();
    if (!found) return found;
    const std::string itself = std::get<Symbol>(p_.node()).name;
    for (const char* sign : {" = 0", " > 0", " < 0"}) std::erase(found->assumes, itself + sign);
    for (const std::string& needed : needed_) {
      if (std::ranges::find(found->assumes, needed) == found->assumes.end()) found->assumes.push_back(needed);
    }
    return found;
  }

 private:
  std::optional<ClosedForm> found_form() {
    BestForm best(values_, {});
    const auto proven = exact_place(problem_);
    consider(proven ? *proven : special_place(problem_), best);
    const bool is_fold = !is_of_oscillations(critical_.kind);
    for (std::size_t i = 0; is_fold && !best.form() && i < motions_.forces.size(); ++i) {
      const auto problem = fold_along(i);
      if (const auto place = problem ? exact_place(*problem) : std::nullopt) consider(*place, best);
    }
    return best.form();
  }

  /// A fold where force i gives the parameter by the place. What is left is to find the place from the other
  /// forces and from det K, with that parameter put in.
  [[nodiscard]] std::optional<PlaceProblem> fold_along(std::size_t i) const {
    const auto value = parameter_in(motions_.forces[i]);
    if (!value) return std::nullopt;
    const std::vector<Replacement> p{{p_, *value}};
    PlaceProblem problem = problem_;
    std::vector<Expression> left{determinant(motions_.stiffness)};
    for (std::size_t k = 0; k < motions_.forces.size(); ++k) {
      if (k != i) left.push_back(motions_.forces[k]);
    }
    problem.forces = motions_.surface;
    for (const Expression& e : left) {
      const Polynomial above = rational_function(substitute(e, p)).above;
      if (above.empty()) return std::nullopt;
      problem.forces.push_back(to_expression(*motions_.graph, above));
    }
    return problem;
  }

  /// The parameter by the place, from a force.
  [[nodiscard]] std::optional<Expression> parameter_in(const Expression& force) const {
    if (!depends_on(force, p_)) return std::nullopt;
    const auto c = quadratic_in(force, p_);
    if (c && ((*c)[1].is_zero() || (*c)[2].is_zero())) {
      const bool squared = (*c)[1].is_zero();
      const Expression power = -(*c)[0] / (*c)[squared ? 2 : 1];
      return squared ? sqrt(power) : power;
    }
    const Interval near(critical_.value - critical_.error, critical_.value + critical_.error);
    return solved_for(force, p_, near, values_.sign_of());
  }

  [[nodiscard]] static Matrix at(const ExactPlace& place, Matrix m) {
    for (auto& row : m) {
      for (Expression& e : row) e = place.at(e);
    }
    return m;
  }

  [[nodiscard]] static Entries rationals(const Matrix& m) {
    Entries result;
    for (const auto& row : m) {
      result.emplace_back();
      for (const Expression& e : row) result.back().push_back(rational_function(e));
    }
    return result;
  }

  [[nodiscard]] static Matrix part(const Matrix& m, const std::vector<std::size_t>& group) {
    Matrix result;
    for (const std::size_t i : group) {
      result.emplace_back();
      for (const std::size_t j : group) result.back().push_back(m[i][j]);
    }
    return result;
  }

  /// Of each group of coordinates that no entry couples to others.
  void consider(const ExactPlace& place, BestForm& best) {
    std::vector<Expression> forces;
    for (const Expression& force : motions_.forces) forces.push_back(place.at(force));
    const Matrix mass = at(place, motions_.mass), damping = at(place, motions_.damping),
                 stiffness = at(place, motions_.stiffness);
    for (const auto& group : coupled_groups({rationals(mass), rationals(damping), rationals(stiffness)})) {
      std::vector<Expression> conditions = forces;
      std::optional<Expression> square;
      if (is_of_oscillations(critical_.kind)) {
        const auto growth =
            growing_oscillations(part(mass, group), part(damping, group), part(stiffness, group));
        if (growth) conditions.push_back(growth->condition);
        if (growth) square = growth->square;
      } else {
        conditions.push_back(determinant(part(stiffness, group)));
      }
      std::erase_if(conditions, [](const Expression& e) { return rational_function(e).is_zero(); });
      if (critical_.value == 0 && conditions.empty()) {
        if (!square) square = free_square(part(mass, group), part(damping, group), part(stiffness, group));
        consider_zero({conditions, square, place, none_}, best);
      }
      for (const Relations& relations : {Relations{}, values_.relations()}) {
        for (const Expression& condition : conditions)
          consider(condition, {conditions, square, place, relations}, best);
      }
    }
  }

  /// What vanishes at a critical value.
  struct Claims {
    const std::vector<Expression>& all;
    const std::optional<Expression>& square;  ///< of the rate at which something begins to oscillate
    const ExactPlace& place;
    const Relations& relations;
  };

  /// omega^2 of what is not damped at the critical value.
  [[nodiscard]] std::optional<Expression> free_square(const Matrix& mass, const Matrix& damping,
                                                      Matrix stiffness) const {
    const double square = critical_.omega * critical_.omega;
    const Expression lambda = motions_.graph->symbol("omega^2");
    for (std::size_t i = 0; i < mass.size(); ++i) {
      for (std::size_t j = 0; j < mass.size(); ++j) {
        if (!damping[i][j].is_zero()) return std::nullopt;
        stiffness[i][j] = stiffness[i][j] - lambda * mass[i][j];
      }
    }
    for (const Expression& root : roots_in(determinant(stiffness), lambda, values_)) {
      if (agrees(values_.value(root), square, 3 * critical_.omega * critical_.omega_error)) return root;
    }
    return std::nullopt;
  }

  /// The system was derived without a parameter that is 0: all holds there, if what may grow oscillates.
  void consider_zero(const Claims& claims, BestForm& best) {
    const bool is_known = !is_of_oscillations(critical_.kind) || claims.square;
    const Expression zero = motions_.graph->number(0);
    if (is_known && best.consider(zero, {})) needed_ = signs_needed(zero, claims);
  }

  void consider(const Expression& condition, const Claims& claims, BestForm& best) {
    const Relations& relations = claims.relations;
    const Expression equation = substitute(condition, relations.replacements);
    std::vector<Expression> roots = roots_in(equation, p_, values_);
    if (roots.empty()) {
      const Interval near(critical_.value - critical_.error, critical_.value + critical_.error);
      if (const auto root = solved_for(equation, p_, near, values_.sign_of())) roots.push_back(*root);
    }
    for (const Expression& root : roots) {
      if (!agrees(values_.value(root), critical_.value, critical_.error)) continue;
      Trial trial(values_, relations);
      trial.set({p_}, {root});
      for (const Expression& other : claims.all) trial.vanishes({substitute(other, {{{p_, root}}})});
      if (trial.passes() && best.consider(root, relations)) needed_ = signs_needed(root, claims);
    }
  }

  /// For the forces and what else vanishes to do so at the place, where the scene has a value.
  [[nodiscard]] std::vector<std::string> signs_needed(const Expression& root, const Claims& claims) const {
    if (!motions_.momenta.empty()) return {};
    const std::array<Replacement, 1> p{{{p_, root}}};
    AssumedSigns signs(values_, claims.relations, {});
    signs.leave_out(p_, root);
    signs.ask(root);
    Trial trial(values_, claims.relations);
    trial.set({p_}, {root});
    std::vector<Expression> there;
    for (const Expression& x : claims.place.x()) {
      there.push_back(substitute(x, p));
      signs.ask_for_value_of(there.back());
    }
    trial.set(motions_.x, there);
    for (const auto* vanishing : {&motions_.forces, &motions_.surface})
      for (const Expression& e : *vanishing) trial.vanishes(terms_of(e));
    for (const Expression& e : claims.all) trial.vanishes({substitute(e, p)});
    if (!is_of_oscillations(critical_.kind)) trial.is_singular(motions_.stiffness);
    if (claims.square) {
      const Expression square = substitute(*claims.square, p);
      signs.ask(square);
      trial.is_positive(square);
    }
    std::vector<std::string> needed = signs.signs_needed_for(trial);
    if (signs.are_there()) std::ranges::move(signs.needed_for(trial), std::back_inserter(needed));
    return needed;
  }

  LinearMotions motions_;
  ExactValues values_;
  Expression p_;
  const CriticalValue& critical_;
  PlaceProblem problem_;
  const Relations none_;
  std::vector<std::string> needed_;  ///< signs that the best form assumes
};

/// With the multipliers that hold the system there as coordinates of their own; one that is nearly 0 may be
/// 0, which is then proven.
CriticalValue with_multipliers_of(const Dynamics& dynamics, const Reals& there, CriticalValue critical) {
  constexpr double rounding = 1e-12;
  const std::size_t n = critical.y.size() / 2;
  critical.y = with_multipliers(dynamics, there, critical.y);
  critical.errors.resize(n);
  for (std::size_t j = n; j < critical.y.size(); ++j)
    critical.errors.push_back(rounding * std::max(1.0, std::abs(critical.y[j])));
  critical.y.resize(2 * critical.y.size());
  return critical;
}

/// The formula of a critical value. With constraints det K of (q, lambda) is used, which vanishes where that
/// of the displacements on their surface does.
std::optional<ClosedForm> critical_form(const Dynamics& dynamics, const Reals& given, const Reals& there,
                                        const Reals& y, std::size_t index, const WrittenTexts& written,
                                        const CriticalValue& critical) {
  if (dynamics.model().has_constraints()) {
    const SurfaceStatics whole = surface_statics(dynamics, there);
    if (!whole.statics->reduction.ignored.empty() || whole.coordinates > largest_written_system)
      return std::nullopt;
    const CriticalValue place = with_multipliers_of(dynamics, there, critical);
    return CriticalForm(*whole.dynamics, *whole.statics, there, index, written, place).form();
  }
  auto statics = dynamics.statics(there);
  if (statics->reduction.degrees_of_freedom() > largest_written_system) return std::nullopt;
  if (!momenta_vanish(dynamics, *statics, there, y))
    statics = with_written_momenta(dynamics, there, {given, y});
  if (!statics) return std::nullopt;
  return CriticalForm(dynamics, *statics, there, index, written, critical).form();
}

}  // namespace

std::vector<std::optional<ClosedForm>> exact_critical_values(const Dynamics& dynamics,
                                                             const Reals& parameters, const Reals& y,
                                                             std::size_t index, const WrittenTexts& written,
                                                             const Bifurcations& found) {
  std::vector<std::optional<ClosedForm>> result;
  for (const CriticalValue& critical : found.critical) {
    result.emplace_back();
    Reals there = parameters;
    there.set(index, critical.value);
    try {
      const WorkScope budget(most_algebra);
      result.back() = critical_form(dynamics, parameters, there, y, index, written, critical);
    } catch (const Error&) {  // as above
    }
  }
  return result;
}

}  // namespace qdot
