#include "core/closed/exact_solution.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/equal_parts.hpp"
#include "core/closed/exact_roots.hpp"
#include "core/closed/inverted_roots.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/closed/place_search.hpp"
#include "core/closed/trial.hpp"
#include "core/steady/followed_momenta.hpp"
#include "core/steady/growing_oscillations.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {
namespace {

using Forms = std::vector<std::optional<ClosedForm>>;

/// Keeps the shortest of the formulas that agree with a number, and the relations that it uses.
class Best {
 public:
  Best(const ExactValues& values, std::vector<Expression> allowed)
      : values_(values), allowed_(std::move(allowed)) {}

  void consider(const Expression& e, const Relations& relations) {
    if (length_ && *length_ <= written_length(e)) return;
    auto form = closed_form(values_, e, relations, allowed_);
    if (!form) return;
    length_ = written_length(e);
    form_ = std::move(form);
    chosen_ = {e, relations};
  }
  [[nodiscard]] const std::optional<ClosedForm>& form() const { return form_; }
  /// What was kept; only where there is a form.
  [[nodiscard]] const std::pair<Expression, Relations>& chosen() const { return chosen_; }

 private:
  const ExactValues& values_;
  std::vector<Expression> allowed_;
  std::optional<std::size_t> length_;
  std::optional<ClosedForm> form_;
  std::pair<Expression, Relations> chosen_;
};

std::optional<std::size_t> parameter_number(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.parameters, name, &Parameter::name);
  if (found == scene.parameters.end()) return std::nullopt;
  return static_cast<std::size_t>(found - scene.parameters.begin());
}

Reals with(Reals parameters, std::optional<std::size_t> index, double value) {
  if (index) parameters.set(*index, value);
  return parameters;
}

class SolutionForms {
 public:
  SolutionForms(const Dynamics& dynamics, const Reals& parameters, const Reals& y, const std::string& unknown,
                const WrittenTexts& written, const Solution& found)
      : polynomial_(*found.polynomial),
        graph_(std::make_shared<Graph>(*polynomial_.graph)),
        values_(dynamics.model(), graph_, written,
                with(parameters, parameter_number(dynamics.model().scene, unknown), 1),
                parameter_number(dynamics.model().scene, unknown)),
        u_(graph_->symbol(unknown)),
        found_(found) {
    const Symbols::Varying& q = dynamics.model().parsed.symbols.coordinates;
    for (std::size_t i = 0; i < q.value.size(); ++i) {
      take(graph_->adopt(q.value[i]), y.exact(i));
      take(graph_->symbol(dynamics.model().scene.coordinates[i].name + "_dot"), y.exact(q.value.size() + i));
    }
  }

  std::vector<ExactSolution> forms() const {
    std::vector<ExactSolution> result(found_.values.size());
    std::vector<Best> best(found_.values.size(), Best(values_, places_));
    for (const Relations& relations : {Relations{}, values_.relations()}) {
      for (const Expression& root : roots(relations)) {
        for (std::size_t i = 0; i < best.size(); ++i) {
          if (agrees(values_.value(root), found_.values[i].value, found_.values[i].error))
            best[i].consider(root, relations);
        }
      }
    }
    for (std::size_t i = 0; i < best.size(); ++i) {
      if (!best[i].form()) consider_inverses(found_.values[i], best[i]);
      result[i].value = best[i].form();
      const auto& rate2 = found_.values[i].stability.rate2;
      if (result[i].value && rate2 && rate2->is_finite())
        result[i].rate2 = square_of_rate(*rate2, best[i].chosen().first, best[i].chosen().second);
    }
    return result;
  }

 private:
  void take(const Expression& symbol, const Real& value) {
    if (symbol == u_) return;
    places_.push_back(symbol);
    numbers_.push_back(graph_->number(Number::real(value.value)));
    values_.set(symbol, value);
  }

  /// Formulas of roots of one force that are right for other values of the parameters, too.
  [[nodiscard]] std::vector<Expression> roots(const Relations& relations) const {
    std::vector<Expression> found;
    for (std::size_t k = 0; k < polynomial_.forces.size(); ++k) {
      if (!polynomial_.forces[k].degree || !polynomial_.forces[k].depends) continue;
      std::vector<Expression> c;
      for (std::size_t i = 0; i < 3; ++i)
        c.push_back(substitute(graph_->adopt(polynomial_.forms[3 * k + i]), relations.replacements));
      for (const Expression& root : roots_of(c[0], c[1], c[2], values_.sign_of())) {
        if (holds(root, k, relations)) found.push_back(root);
      }
    }
    return found;
  }

  /// Of a force in which u stands under a sine, a root or an exponent.
  void consider_inverses(const SolvedValue& value, Best& best) const {
    ExactValues here = values_;
    here.set(u_, Real(value.value, 0, value.error));
    const Interval near(value.value - value.error, value.value + value.error);
    for (const Relations& relations : {Relations{}, values_.relations(), zeros()}) {
      for (std::size_t k = 0; k < polynomial_.whole.size() && !best.form(); ++k) {
        const Expression force = substitute(graph_->adopt(polynomial_.whole[k]), relations.replacements);
        if (!depends_on(force, u_)) continue;
        std::vector<Expression> roots = inverted_roots(force, u_, here);
        if (const auto root = solved_for(force, u_, near, here.sign_of())) roots.push_back(*root);
        for (const Expression& root : roots) {
          if (!agrees(values_.value(root), value.value, value.error)) continue;
          Trial trial = trial_at(root, relations);
          trial.vanishes(terms_of(force));
          if (trial.passes()) best.consider(root, relations);
        }
      }
    }
  }

  /// What of the position is 0: without it, equations are simpler.
  [[nodiscard]] Relations zeros() const {
    Relations result;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (numbers_[i].is_zero()) result.replacements.emplace_back(places_[i], numbers_[i]);
    }
    return result;
  }

  /// The square of the rate, K/M, with u replaced by its value in the other parameters.
  [[nodiscard]] std::optional<ClosedForm> square_of_rate(const Interval& number, const Expression& u,
                                                         const Relations& relations) const {
    const auto there = [&](const Expression& e) {
      std::vector<Replacement> all = relations.replacements;
      all.emplace_back(u_, u);
      return substitute(e, all);
    };
    const Expression k = graph_->adopt(polynomial_.stiffness), m = graph_->adopt(polynomial_.inertia);
    const std::vector<Expression> forms = roots_of(there(-k), there(m), graph_->number(0), values_.sign_of());
    if (forms.empty() || !agrees(values_.value(forms[0]), number.middle(), number.width()))
      return std::nullopt;
    Trial trial = trial_at(u, relations);
    trial.vanishes({k, -(m * forms[0])});
    return trial.passes() ? closed_form(values_, forms[0], relations, places_) : std::nullopt;
  }

  [[nodiscard]] Trial trial_at(const Expression& u, const Relations& relations) const {
    Trial trial(values_, relations);
    trial.set(places_, numbers_);
    trial.set({u_}, {u});
    return trial;
  }

  [[nodiscard]] bool holds(const Expression& root, std::size_t k, const Relations& relations) const {
    Trial trial = trial_at(root, relations);
    const auto c = [&](std::size_t i) { return graph_->adopt(polynomial_.forms[3 * k + i]); };
    trial.vanishes({c(0), c(1) * u_, c(2) * u_ * u_});
    return trial.passes();
  }

  const SteadyPolynomial& polynomial_;
  std::shared_ptr<Graph> graph_;
  ExactValues values_;
  Expression u_;
  const Solution& found_;
  std::vector<Expression> places_, numbers_;  ///< what the position gives
};

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

  std::optional<ClosedForm> form() const {
    std::optional<ClosedForm> found = found_form();
    const std::string itself = std::get<Symbol>(p_.node()).name + " = 0";
    if (found) std::erase(found->assumes, itself);
    return found;
  }

 private:
  std::optional<ClosedForm> found_form() const {
    Best best(values_, {});
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
  void consider(const ExactPlace& place, Best& best) const {
    std::vector<Expression> forces;
    for (const Expression& force : motions_.forces) forces.push_back(place.at(force));
    const Matrix mass = at(place, motions_.mass), damping = at(place, motions_.damping),
                 stiffness = at(place, motions_.stiffness);
    for (const auto& group : coupled_groups({rationals(mass), rationals(damping), rationals(stiffness)})) {
      std::vector<Expression> conditions = forces;
      if (is_of_oscillations(critical_.kind)) {
        const auto growth =
            growing_oscillations(part(mass, group), part(damping, group), part(stiffness, group));
        if (growth) conditions.push_back(growth->condition);
      } else {
        conditions.push_back(determinant(part(stiffness, group)));
      }
      std::erase_if(conditions, [](const Expression& e) { return rational_function(e).is_zero(); });
      // The system was derived without a parameter that is 0: all holds there.
      if (critical_.value == 0 && conditions.empty()) best.consider(motions_.graph->number(0), {});
      for (const Relations& relations : {Relations{}, values_.relations()}) {
        for (const Expression& condition : conditions) consider(condition, conditions, relations, best);
      }
    }
  }

  void consider(const Expression& condition, const std::vector<Expression>& all, const Relations& relations,
                Best& best) const {
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
      for (const Expression& other : all) trial.vanishes({substitute(other, {{{p_, root}}})});
      if (trial.passes()) best.consider(root, relations);
    }
  }

  LinearMotions motions_;
  ExactValues values_;
  Expression p_;
  const CriticalValue& critical_;
  PlaceProblem problem_;
};

}  // namespace

std::vector<ExactSolution> exact_solutions(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                                           const std::string& unknown, const WrittenTexts& written,
                                           const Solution& found) {
  const std::vector<ExactSolution> none(found.values.size());
  if (found.values.empty() || !found.polynomial) return none;
  try {
    const WorkScope budget(most_algebra);
    return SolutionForms(dynamics, parameters, y, unknown, written, found).forms();
  } catch (const Error&) {  // the algebra grows too large, or divides by what vanishes
    return none;
  }
}

namespace {

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

Forms exact_critical_values(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                            std::size_t index, const WrittenTexts& written, const Bifurcations& found) {
  Forms result;
  for (const CriticalValue& critical : found.critical) {
    result.emplace_back();
    const Reals there = with(parameters, index, critical.value);
    try {
      const WorkScope budget(most_algebra);
      result.back() = critical_form(dynamics, parameters, there, y, index, written, critical);
    } catch (const Error&) {  // as above
    }
  }
  return result;
}

}  // namespace qdot
