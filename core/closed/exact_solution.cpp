#include "core/closed/exact_solution.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/short_number.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/assumed_signs.hpp"
#include "core/closed/best_form.hpp"
#include "core/closed/exact_roots.hpp"
#include "core/closed/inverted_roots.hpp"
#include "core/closed/place_search.hpp"
#include "core/closed/taken_squares.hpp"
#include "core/closed/trial.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/rational_function.hpp"

namespace qdot {
namespace {

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
    std::vector<BestForm> best(found_.values.size(), BestForm(values_, places_));
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
      if (!result[i].value) continue;
      const auto& [u, relations] = best[i].chosen();
      assume(*result[i].value, signs_needed(u, relations));
      const auto& rate2 = found_.values[i].stability.rate2;
      if (rate2 && rate2->is_finite()) result[i].rate2 = form_of_rate(*rate2, u, relations);
    }
    return result;
  }

 private:
  static void assume(ClosedForm& form, const std::vector<std::string>& needed) {
    form.assumes.insert(form.assumes.end(), needed.begin(), needed.end());
  }

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
  void consider_inverses(const SolvedValue& value, BestForm& best) const {
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
    for (const auto& [e, sign] : here.asked())
      if (!depends_on(e, u_)) (void)values_.sign(e);  // so that it counts as asked of these, too
  }

  /// What of the position is 0: without it, equations are simpler.
  [[nodiscard]] Relations zeros() const {
    Relations result;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (numbers_[i].is_zero()) result.replacements.emplace_back(places_[i], numbers_[i]);
    }
    return result;
  }

  /// The square of the rate, K/M, with u replaced by its value in the other parameters, and squares taken out
  /// of roots by the signs at this position.
  [[nodiscard]] std::optional<Expression> square_of_rate(const Interval& number, const Expression& u,
                                                         const Relations& relations) const {
    const auto there = [&](const Expression& e) {
      std::vector<Replacement> all = relations.replacements;
      all.emplace_back(u_, u);
      return with_squares_taken_out(substitute(e, all), values_.sign_of());
    };
    const Expression k = graph_->adopt(polynomial_.stiffness), m = graph_->adopt(polynomial_.inertia);
    const std::vector<Expression> forms = roots_of(there(-k), there(m), graph_->number(0), values_.sign_of());
    if (forms.empty() || !agrees(values_.value(forms[0]), number.middle(), number.width()))
      return std::nullopt;
    Trial trial = trial_at(u, relations);
    trial.vanishes({k, -(m * forms[0])});
    return trial.passes() ? std::optional(forms[0]) : std::nullopt;
  }

  [[nodiscard]] std::optional<ClosedForm> form_of_rate(const Interval& rate2, const Expression& u,
                                                       const Relations& relations) const {
    try {
      const auto square = square_of_rate(rate2, u, relations);
      auto form = square ? closed_form(values_, *square, relations, places_) : std::nullopt;
      if (form) assume(*form, signs_needed(u, relations, *square));
      return form;
    } catch (const Error&) {  // the algebra grows too large, where that of the value does not
      return std::nullopt;
    }
  }

  /// For the forces to vanish at any position, and for the square of the rate there to be this.
  [[nodiscard]] std::vector<std::string> signs_needed(const Expression& u, const Relations& relations,
                                                      const std::optional<Expression>& square = {}) const {
    std::vector<Expression> free, held, numbers;
    std::vector<std::string> needed;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!is_held(i, u)) {
        free.push_back(places_[i]);
        continue;
      }
      held.push_back(places_[i]);
      numbers.push_back(numbers_[i]);
      needed.push_back(print(places_[i], Form::text) + " = " +
                       short_number(values_.value(places_[i]).value, 15));
    }
    AssumedSigns signs(values_, relations, free);
    signs.leave_out(u_);
    signs.let_signs_go();
    signs.ask_for_value_of(u);
    if (!signs.are_there()) return needed;
    Trial trial(values_, relations);
    trial.set_given(free);
    trial.set(held, numbers);
    trial.set({u_}, {u});
    for (const Expression& force : polynomial_.whole) trial.vanishes(terms_of(graph_->adopt(force)));
    if (square)
      trial.vanishes({graph_->adopt(polynomial_.stiffness), -(graph_->adopt(polynomial_.inertia) * *square)});
    const std::vector<std::string> of_signs = signs.needed_for(trial);
    needed.insert(needed.end(), of_signs.begin(), of_signs.end());
    return needed;
  }

  /// Whether some force vanishes there, whatever the unknown is or where it is 0, and would not at another
  /// value of this coordinate.
  [[nodiscard]] bool is_held(std::size_t place, const Expression& u) const {
    for (const std::size_t k : found_.without_force) {
      const Expression force = graph_->adopt(polynomial_.whole[k]);
      const auto alone = first_that_stops(force);
      if (alone ? *alone == place : depends_on(force, places_[place])) return true;
    }
    for (std::size_t k = 0; k < polynomial_.forces.size() && u.is_zero(); ++k) {
      const bool has_constant = polynomial_.forces[k].degree.has_value();
      if (has_constant && depends_on(graph_->adopt(polynomial_.forms[3 * k]), places_[place])) return true;
    }
    return false;
  }

  /// A coordinate that makes the force vanish by itself, wherever the others are.
  [[nodiscard]] std::optional<std::size_t> first_that_stops(const Expression& force) const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Replacement there{places_[i], numbers_[i]};
      if (depends_on(force, places_[i]) && rational_function(substitute(force, {&there, 1})).is_zero())
        return i;
    }
    return std::nullopt;
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
}  // namespace qdot
