#include "core/closed/exact_turning.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/elastic_period.hpp"
#include "core/closed/period_form.hpp"
#include "core/closed/place_algebra.hpp"
#include "core/closed/start_sides.hpp"
#include "core/closed/turning_equation.hpp"
#include "core/closed/turning_signs.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class TurningForms {
 public:
  TurningForms(const Dynamics& dynamics, const Reals& parameters, const WrittenTexts& written,
               const TurningPoints& found, const std::string& energy_name)
      : equation_(dynamics, parameters, written, found, energy_name) {}

  ExactTurningPoints forms() {
    ExactTurningPoints result;
    if (equation_.take_start())
      result = forms_from_start();
    else if (equation_.by_constants)
      result = with_place_of_start(forms_by_constants());
    put_walls(result);
    return result;
  }

  /// The period by h and the momenta, or with the initial state put in where that is shorter. Needs forms()
  /// first.
  [[nodiscard]] std::optional<ClosedForm> period() const {
    const bool returns =
        equation_.found.motion == MotionKind::libration || equation_.found.motion == MotionKind::rotation;
    if (!equation_.found.period.value || !returns) return std::nullopt;
    std::optional<ClosedForm> best;
    if (equation_.by_constants)
      best = period_of({equation_.x, equation_.inertia, equation_.potential, equation_.energy_symbol}, {});
    if (!equation_.energy) return best;
    std::optional<ClosedForm> other =
        period_of({equation_.x, substitute(equation_.inertia, equation_.momenta),
                   substitute(equation_.potential, equation_.momenta), *equation_.energy},
                  equation_.assumed);
    return !best || (other && other->text.size() < best->text.size()) ? other : best;
  }

 private:
  [[nodiscard]] std::optional<Expression> place_of(const std::optional<ElasticWall>& wall) const {
    if (!wall) return std::nullopt;
    const Model& model = equation_.values.model();
    const auto event = std::ranges::find(model.scene.events, wall->event, &SceneEvent::name);
    const auto number = static_cast<std::size_t>(event - model.scene.events.begin());
    return place_of_wall(*equation_.graph, model, equation_.graph->adopt(model.parsed.events[number].value));
  }

  /// Extrema at walls are these.
  void put_walls(ExactTurningPoints& result) const {
    if (!equation_.found.walls) return;
    const auto put = [&](const std::optional<ElasticWall>& wall, std::optional<ExactExtremum>& extremum) {
      const auto place = place_of(wall);
      auto form = place ? closed_form(equation_.values, *place, {}) : std::nullopt;
      if (!form) return;
      const std::vector<std::string> needed = signs_of_wall(equation_, *place);
      form->assumes.insert(form->assumes.end(), needed.begin(), needed.end());
      extremum = ExactExtremum{*std::move(form), std::nullopt, std::nullopt};
    };
    put(equation_.found.walls->below, result.minimum);
    put(equation_.found.walls->above, result.maximum);
  }

  [[nodiscard]] std::optional<ClosedForm> period_of(const QuadratureProblem& problem,
                                                    const std::vector<std::string>& started) const {
    const auto written = [&](const Expression& e, const Relations& relations) {
      return equation_.formula(e, relations, started);
    };
    WallPlaces walls;
    if (equation_.found.walls)
      walls = {place_of(equation_.found.walls->below), place_of(equation_.found.walls->above)};
    auto period = equation_.found.walls ? elastic_form(problem, walls, written)
                                        : period_form(problem, equation_.values, *equation_.found.motion,
                                                      equation_.found.period, written);
    if (!period) return std::nullopt;
    const auto needed = signs_of_period(equation_, problem, *period, walls);
    if (!needed) return std::nullopt;
    period->form.assumes.insert(period->form.assumes.end(), needed->begin(), needed->end());
    return std::move(period->form);
  }

  [[nodiscard]] std::optional<PeriodFormula> elastic_form(const QuadratureProblem& problem,
                                                          const WallPlaces& walls,
                                                          const WrittenForm& written) const {
    const Finding& period = equation_.found.period;
    if (!walls.below && !walls.above) return std::nullopt;
    for (const Expression& e : elastic_periods(problem, walls.below, walls.above, equation_.values)) {
      const Expression joined = simplify(e);
      const Expression& factor = written_length(joined) < written_length(e) ? joined : e;
      if (!agrees(equation_.values.value(factor), *period.value, period.error)) continue;
      auto form = written(factor, {});
      if (!form) return std::nullopt;
      return PeriodFormula{.form = *std::move(form), .factor = short_form(equation_.values, factor)};
    }
    return std::nullopt;
  }

  static ClosedForm with_zero(ClosedForm form) {
    form.text += " = 0";
    form.latex += " = 0";
    return form;
  }

  ExactTurningPoints forms_from_start() {
    ExactTurningPoints result;
    const Expression balance = equation_.with_start();
    ExactExtrema extrema(equation_);
    if (equation_.found.energy.value)
      result.energy =
          constant(simplify(*equation_.energy), *equation_.found.energy.value, equation_.found.energy.error);
    for (std::size_t c = 0; c < equation_.momenta.size(); ++c)
      result.momenta.push_back(constant(equation_.momenta[c].second, equation_.found.momenta[c],
                                        equation_.found.momenta_errors[c]));
    std::size_t length = 0;
    for (const Relations& relations : {equation_.values.relations(), Relations{}}) {
      const Expression left = divided(substitute(balance, relations.replacements));
      if (left.is_zero() || !depends_on(left, equation_.x)) return {};
      if (!result.equation || written_length(left) < length) {
        if (auto form = equation_of(balance, left, relations)) {
          length = written_length(left);
          result.equation = with_zero(*std::move(form));
        }
      }
      extrema.consider(left, relations);
      extrema.consider_start(left, relations);
    }
    extrema.assume_signs();
    result.maximum = std::move(extrema.maximum);
    result.minimum = std::move(extrema.minimum);
    const bool is_angle =
        equation_.values.model().scene.coordinates[equation_.found.coordinate].unit == "rad";
    if (equation_.by_constants && !is_angle && !(is_short(result.maximum) && is_short(result.minimum))) {
      const auto started = std::exchange(equation_.assumed, {});
      ExactTurningPoints other = forms_by_constants();
      equation_.assumed = started;
      take_much_shorter(result.maximum, std::move(other.maximum));
      take_much_shorter(result.minimum, std::move(other.minimum));
    }
    return result;
  }

  /// Numbers with decimals are none that a book would print.
  static bool is_short(const std::optional<ExactExtremum>& extremum) {
    constexpr std::size_t short_text = 40;
    return extremum && extremum->value.text.size() <= short_text && !has_decimals(extremum->value);
  }

  static bool has_decimals(const ClosedForm& form) { return form.text.find('.') != std::string::npos; }

  static void take_much_shorter(std::optional<ExactExtremum>& best, std::optional<ExactExtremum>&& other) {
    if (!other) return;
    const std::size_t length = other->value.text.size();
    if (!best || 2 * best->value.text.size() > 3 * length ||
        (has_decimals(best->value) && best->value.text.size() > length))
      best = std::move(other);
  }

  ExactTurningPoints forms_by_constants() {
    ExactExtrema extrema(equation_);
    const Expression balance = equation_.potential - equation_.energy_symbol;
    for (const Relations& relations : {equation_.values.relations(), Relations{}}) {
      const Expression left = divided(substitute(balance, relations.replacements));
      if (left.is_zero() || !depends_on(left, equation_.x)) return {};
      extrema.consider(left, relations);
    }
    extrema.assume_signs();
    return {.maximum = std::move(extrema.maximum), .minimum = std::move(extrema.minimum)};
  }

  /// An end that is no root by the constants may be one beside the other end, where the motion begins.
  ExactTurningPoints with_place_of_start(ExactTurningPoints result) {
    const TurningPoints& found = equation_.found;
    const bool lacks_one =
        (found.maximum.value && !result.maximum) || (found.minimum.value && !result.minimum);
    const bool is_at_end = found.initial == InitialPlace::maximum || found.initial == InitialPlace::minimum;
    if (!lacks_one || !is_at_end || !equation_.take_place_of_start()) return result;
    ExactExtrema extrema(equation_);
    const Expression left = divided(equation_.potential - *equation_.energy);
    if (!left.is_zero() && depends_on(left, equation_.x)) extrema.consider(left, {});
    extrema.assume_signs();
    if (!result.maximum) result.maximum = std::move(extrema.maximum);
    if (!result.minimum) result.minimum = std::move(extrema.minimum);
    equation_.leave_start();
    return result;
  }

  /// A constant of the motion, in the shorter of its forms.
  [[nodiscard]] std::optional<ClosedForm> constant(const Expression& e, double value, double error) const {
    if (!agrees(equation_.values.value(e), value, error)) return std::nullopt;
    const Relations& relations = equation_.values.relations();
    const Expression general = to_expression(*equation_.graph, rational_function(e));
    const Expression related = simplify(with_signs_taken(substitute(e, relations.replacements)));
    if (written_length(related) < written_length(general)) {
      if (auto form = constant(e, related, relations)) return form;
    }
    return constant(e, general, {});
  }

  [[nodiscard]] std::optional<ClosedForm> constant(const Expression& e, const Expression& formula,
                                                   const Relations& relations) const {
    auto form = equation_.formula(formula, relations, equation_.assumed);
    if (!form) return form;
    return with_sides(*form, sides_of_constant(equation_, e, formula, relations, form->assumes));
  }

  [[nodiscard]] std::optional<ClosedForm> equation_of(const Expression& balance, const Expression& left,
                                                      const Relations& relations) const {
    auto form = equation_.formula(left, relations, equation_.assumed, {&equation_.x, 1});
    if (!form) return form;
    return with_sides(*form, sides_of_equation(equation_, balance, left, relations, form->assumes));
  }

  static std::optional<ClosedForm> with_sides(ClosedForm form,
                                              const std::optional<std::vector<std::string>>& sides) {
    if (!sides) return std::nullopt;
    form.assumes.insert(form.assumes.end(), sides->begin(), sides->end());
    return form;
  }

  /// sqrt(d^2) and |d| as d where d > 0.
  [[nodiscard]] Expression with_signs_taken(const Expression& e) const {
    const SignOf sign = equation_.values.sign_of();
    return with_roots_taken(with_sizes_taken(e, sign), sign);
  }

  /// Without the factors that all terms share, its largest number 1: 1/8 (1/2 + sin x)^-2 - cos x + 1/2.
  [[nodiscard]] Expression divided(const Expression& e) const {
    Polynomial terms = multiplied_out(simplify(with_signs_taken(e)));
    if (terms.empty()) return equation_.graph->number(0);
    Monomial common = common_monomial(terms);
    std::erase_if(common, [&](const Atom& atom) {
      return depends_on(Expression(*equation_.graph, atom.base), equation_.x);
    });
    const auto size = [](const auto& term) { return term.second.is_negative() ? -term.second : term.second; };
    const auto largest =
        std::ranges::max_element(terms, [&](const auto& a, const auto& b) { return size(a) < size(b); });
    const Expression quotient =
        to_expression(*equation_.graph, scaled(terms, inverse(common), Number(1) / size(*largest)));
    const Expression simple = simplify(quotient);
    const Expression& best = written_length(simple) < written_length(quotient) ? simple : quotient;
    return split_coefficient(best).rest;  // zero as well
  }

  TurningEquation equation_;
};

}  // namespace

ExactTurningPoints exact_turning_points(const Dynamics& dynamics, const Reals& parameters,
                                        const WrittenTexts& written, const TurningPoints& found,
                                        const std::string& energy_name) {
  ExactTurningPoints result;
  std::optional<TurningForms> forms;
  const auto tried = [](const auto& search) {
    try {
      const WorkScope budget(most_algebra);
      search();
    } catch (const Error&) {  // the algebra grows too large, or divides by what vanishes
    }
  };
  tried([&] {
    forms.emplace(dynamics, parameters, written, found, energy_name);
    result = forms->forms();
  });
  tried([&] {
    if (forms) result.period = forms->period();
  });
  return result;
}

}  // namespace qdot
