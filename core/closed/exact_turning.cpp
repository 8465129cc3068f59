#include "core/closed/exact_turning.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/exact_roots.hpp"
#include "core/closed/period_form.hpp"
#include "core/closed/trial.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/special_angles.hpp"
#include "core/expr/trigonometry.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot {
namespace {

class TurningForms {
 public:
  TurningForms(const Dynamics& dynamics, const Reals& parameters, const WrittenTexts& written,
               const TurningPoints& found, const std::string& energy_name)
      : statics_(dynamics.statics(parameters)),
        graph_(std::make_shared<Graph>(*statics_->reduction.graph)),
        values_(dynamics.model(), graph_, written, parameters),
        found_(found),
        x_(graph_->adopt(statics_->reduction.x[0])),
        is_angle_(dynamics.model().scene.coordinates[found.coordinate].unit == "rad") {
    take_constants(energy_name);
  }

  ExactTurningPoints forms() {
    if (take_initial_state()) return forms_from_start();
    start_.clear();
    assumed_.clear();
    return by_constants_ ? forms_by_constants() : ExactTurningPoints{};
  }

  /// By h and the momenta, or with the initial state put in where that is shorter. After forms().
  [[nodiscard]] std::optional<ClosedForm> period() const {
    const bool returns = found_.motion == MotionKind::libration || found_.motion == MotionKind::rotation;
    if (!found_.period.value || !returns) return std::nullopt;
    const auto form_of = [&](const QuadratureProblem& problem, const std::vector<std::string>& started) {
      return period_form(
          problem, values_, *found_.motion, found_.period,
          [&](const Expression& e, const Relations& relations) { return formula(e, relations, started); });
    };
    std::optional<ClosedForm> best;
    if (by_constants_) best = form_of({x_, inertia_, potential_, energy_symbol_}, {});
    if (!energy_) return best;
    std::optional<ClosedForm> other =
        form_of({x_, substitute(inertia_, momenta_), substitute(potential_, momenta_), *energy_}, assumed_);
    return !best || (other && other->text.size() < best->text.size()) ? other : best;
  }

 private:
  static ClosedForm with_zero(ClosedForm form) {
    form.text += " = 0";
    form.latex += " = 0";
    return form;
  }

  ExactTurningPoints forms_from_start() {
    ExactTurningPoints result;
    const Expression balance = energy_balance();
    if (found_.energy.value)
      result.energy = constant(simplify(*energy_), *found_.energy.value, found_.energy.error);
    for (std::size_t c = 0; c < momenta_.size(); ++c)
      result.momenta.push_back(constant(momenta_[c].second, found_.momenta[c], found_.momenta_errors[c]));
    std::size_t length = 0;
    for (const Relations& relations : {values_.relations(), Relations{}}) {
      const Expression left = divided(substitute(balance, relations.replacements));
      if (left.is_zero() || !depends_on(left, x_)) return {};
      const auto form = formula(left, relations, assumed_, {&x_, 1});
      const bool better = form && (!result.equation || written_length(left) < length);
      if (better) {
        length = written_length(left);
        result.equation = with_zero(*form);
      }
      consider(left, relations, result);
    }
    return result;
  }

  ExactTurningPoints forms_by_constants() {
    ExactTurningPoints result;
    const Expression balance = potential_ - energy_symbol_;
    for (const Relations& relations : {values_.relations(), Relations{}}) {
      const Expression left = divided(substitute(balance, relations.replacements));
      if (left.is_zero() || !depends_on(left, x_)) return {};
      consider(left, relations, result);
    }
    return result;
  }

  void take_constants(const std::string& energy_name) {
    const Reduction& reduction = statics_->reduction;
    const Expression rate = graph_->adopt(reduction.x_dot[0]);
    const Replacement rest{rate, graph_->number(0)};
    std::vector<Replacement> vanishing;
    for (std::size_t c = 0; c < reduction.ignored.size(); ++c) {
      const std::size_t place = reduction.constants.size() - reduction.ignored.size() + c;
      const Expression p = graph_->adopt(reduction.constants[place]);
      const bool vanishes = found_.momenta[c] == 0 && found_.momenta_errors[c] == 0;
      if (vanishes) vanishing.emplace_back(p, graph_->number(0));
      constants_.push_back(p);
      values_.set(p, {found_.momenta[c], 0, found_.momenta_errors[c]});
    }
    const Expression routhian = substitute(graph_->adopt(reduction.routhian), vanishing);
    potential_ = -substitute(routhian, {&rest, 1});
    inertia_ = substitute(differentiate(differentiate(routhian, rate), rate), {&rest, 1});
    energy_symbol_ = graph_->symbol(energy_name);
    by_constants_ = std::ranges::find(values_.symbols(), energy_symbol_) == values_.symbols().end();
    if (by_constants_) values_.set(energy_symbol_, {*found_.energy.value, 0, found_.energy.error});
    constants_.push_back(energy_symbol_);
  }

  /// (q0, q0') as replacements of all coordinates and velocities. A number with a dimension would leave
  /// formulas whose terms do not fit together.
  bool take_initial_state() {
    const auto& symbols = values_.model().parsed.symbols.coordinates;
    for (std::size_t i = 0; i < symbols.value.size(); ++i) {
      const auto q = values_.coordinate(i), rate = values_.velocity(i);
      if (!q || !rate) return false;
      const Scene& scene = values_.model().scene;
      const auto has_unit = [](const Expression& e) { return e.number() != nullptr && !e.is_zero(); };
      if (!scene.without_units && (has_unit(*rate) || (scene.coordinates[i].unit != "rad" && has_unit(*q))))
        return false;
      take_assumption(i, *q, *rate);
      start_.emplace_back(graph_->adopt(symbols.value[i]), *q);
      start_.emplace_back(graph_->adopt(symbols.rate[i]), *rate);
    }
    return true;
  }

  void take_assumption(std::size_t i, const Expression& q, const Expression& rate) {
    const std::string& name = values_.model().scene.coordinates[i].name;
    const Notation notation = notation_of(values_.model().scene);
    const bool matters = i == found_.coordinate;
    if (matters) assumed_.push_back(name + "(0) = " + print(q, Form::text, notation));
    assumed_.push_back(name + "_dot(0) = " + print(rate, Form::text, notation));
  }

  /// With what was put in for the initial state, and the signs of constants in it.
  [[nodiscard]] std::optional<ClosedForm> formula(const Expression& e, const Relations& relations,
                                                  const std::vector<std::string>& started,
                                                  std::span<const Expression> allowed = {}) const {
    std::vector<Expression> symbols = constants_;
    symbols.insert(symbols.end(), allowed.begin(), allowed.end());
    auto form = closed_form(values_, e, relations, symbols);
    if (!form) return form;
    assume_signs(*form, values_, e, constants_);
    form->assumes.insert(form->assumes.end(), started.begin(), started.end());
    return form;
  }

  [[nodiscard]] Expression at_start(const Expression& e) const {
    return with_special_angles(substitute(e, start_));
  }

  /// U(x; p) - U(x0; p) - 1/2 A(x0) x0'^2 with p of the initial state.
  [[nodiscard]] Expression energy_balance() {
    const Reduction& reduction = statics_->reduction;
    const Expression rate = graph_->adopt(reduction.x_dot[0]);
    for (std::size_t c = 0; c < reduction.ignored.size(); ++c) {
      const Expression p = graph_->adopt(values_.model().momenta[reduction.ignored[c]]);
      momenta_.emplace_back(constants_[c], at_start(without_zeros(p)));
    }
    const Expression potential = substitute(potential_, momenta_);
    const Expression kinetic = Number::ratio(1, 2) * substitute(inertia_, momenta_) * rate * rate;
    energy_ = at_start(potential) + at_start(kinetic);
    return potential - *energy_;
  }

  /// A constant of the motion, in the shorter of its forms.
  [[nodiscard]] std::optional<ClosedForm> constant(const Expression& e, double value, double error) const {
    if (!agrees(values_.value(e), value, error)) return std::nullopt;
    const Relations& relations = values_.relations();
    const Expression general = to_expression(*graph_, rational_function(e));
    const Expression related = simplify(substitute(e, relations.replacements));
    if (written_length(related) < written_length(general)) return formula(related, relations, assumed_);
    return formula(general, {}, assumed_);
  }

  /// The model's expressions know nothing of parameters that are zero.
  [[nodiscard]] Expression without_zeros(const Expression& e) const {
    std::vector<Replacement> zeros;
    for (std::size_t i = 0; i < values_.symbols().size(); ++i) {
      if (values_.parameters()[i] == 0) zeros.emplace_back(values_.symbols()[i], graph_->number(0));
    }
    return substitute(e, zeros);
  }

  /// Without the factors that all terms share, its largest number 1: 1/8 (1/2 + sin x)^-2 - cos x + 1/2.
  [[nodiscard]] Expression divided(const Expression& e) const {
    Polynomial terms = multiplied_out(simplify(e));
    if (terms.empty()) return graph_->number(0);
    Monomial common = common_monomial(terms);
    std::erase_if(common, [&](const Atom& atom) { return depends_on(Expression(*graph_, atom.base), x_); });
    const auto size = [](const auto& term) { return term.second.is_negative() ? -term.second : term.second; };
    const auto largest =
        std::ranges::max_element(terms, [&](const auto& a, const auto& b) { return size(a) < size(b); });
    const Expression quotient =
        to_expression(*graph_, scaled(terms, inverse(common), Number(1) / size(*largest)));
    const Expression simple = simplify(quotient);
    return written_length(simple) < written_length(quotient) ? simple : quotient;
  }

  /// The extrema that are roots of `left`, where their formulas are shorter.
  void consider(const Expression& left, const Relations& relations, ExactTurningPoints& result) const {
    for (const Function function : {Function::cos, Function::sin}) {
      const Expression unknown = is_angle_ ? graph_->call(function, x_) : x_;
      for (const Expression& root : roots_in(unknown, left)) {
        consider(found_.maximum, function, root, left, relations, result.maximum);
        consider(found_.minimum, function, root, left, relations, result.minimum);
      }
      if (!is_angle_) return;
    }
  }

  void consider(const Finding& extremum, Function function, const Expression& root, const Expression& left,
                const Relations& relations, std::optional<ExactExtremum>& best) const {
    if (!extremum.value) return;
    auto found = is_angle_ ? angle(function, root, extremum, relations) : number(root, extremum, relations);
    if (found && is_root(found->first, left, relations) &&
        (!best || found->second.value.text.size() < best->value.text.size()))
      best = std::move(found->second);
  }

  using Found = std::optional<std::pair<Expression, ExactExtremum>>;

  /// Values of the unknown, a cosine say, where `left` is a quadratic polynomial of it.
  [[nodiscard]] std::vector<Expression> roots_in(const Expression& unknown, const Expression& left) const {
    const Polynomial above = with_single_angles(*graph_, rational_function(left).above);
    const Expression u = graph_->symbol("cosine or sine");
    Expression e = to_expression(*graph_, above);
    if (unknown == sin(x_)) {
      const Polynomial sines = without_cosine_squares(*graph_, above, x_);
      e = to_expression(*graph_, sines);
    }
    const Replacement replacement{unknown, u};
    e = substitute(e, {&replacement, 1});
    if (is_angle_ ? depends_on(e, x_) : false) return {};
    if (!is_angle_) return qdot::roots_in(e, u, values_);
    const auto c = quadratic_in(e, u);
    return c ? roots_of((*c)[0], (*c)[1], (*c)[2], values_.sign_of()) : std::vector<Expression>{};
  }

  [[nodiscard]] Found number(const Expression& root, const Finding& extremum,
                             const Relations& relations) const {
    if (!agrees(values_.value(root), *extremum.value, extremum.error)) return std::nullopt;
    auto form = formula(root, relations, assumed_);
    if (!form) return std::nullopt;
    return {{root, {*std::move(form), std::nullopt, std::nullopt}}};
  }

  [[nodiscard]] Found angle(Function function, const Expression& root, const Finding& extremum,
                            const Relations& relations) const {
    const Expression pi = graph_->symbol("pi");
    const Expression inverse =
        graph_->call(function == Function::cos ? Function::acos : Function::asin, root);
    std::vector<Expression> principal{inverse};
    if (const auto* call = std::get_if<Call>(&root.node()); call != nullptr && call->function == function)
      principal.insert(principal.begin(), Expression(*graph_, call->argument));  // where the motion began
    if (root.number() != nullptr || written_length(root) < 8) add_known(function, root, principal);
    for (const Expression& value : principal) {
      const Expression other = function == Function::cos ? -value : pi - value;
      for (const Expression& x : {value, other, other + Number(2) * pi, other - Number(2) * pi}) {
        if (!agrees(values_.value(x), *extremum.value, extremum.error)) continue;
        auto form = formula(x, relations, assumed_);
        auto of_function = formula(root, relations, assumed_);
        if (!form || !of_function) continue;
        ExactExtremum result{*std::move(form), std::nullopt, std::nullopt};
        (function == Function::cos ? result.cosine : result.sine) = std::move(of_function);
        return {{x, std::move(result)}};
      }
    }
    return std::nullopt;
  }

  /// Before acos(1/2): pi/3.
  void add_known(Function function, const Expression& value, std::vector<Expression>& principal) const {
    const Expression pi = graph_->symbol("pi");
    for (const Number& r :
         {Number(0), Number::ratio(1, 6), Number::ratio(1, 4), Number::ratio(1, 3), Number::ratio(1, 2),
          Number::ratio(2, 3), Number::ratio(3, 4), Number::ratio(5, 6), Number(1), Number::ratio(-1, 6),
          Number::ratio(-1, 4), Number::ratio(-1, 3), Number::ratio(-1, 2)}) {
      const Expression angle = r * pi;
      const Expression known = with_special_angles(graph_->call(function, angle));
      if (rational_function(known - value).is_zero()) {
        principal.insert(principal.begin(), angle);
        return;
      }
    }
  }

  /// At other values of the parameters, too.
  [[nodiscard]] bool is_root(const Expression& x, const Expression& left, const Relations& relations) const {
    Trial trial(values_, relations);
    std::vector<Expression> numbers;
    for (const Expression& p : constants_)
      numbers.push_back(graph_->number(Number::real(values_.value(p).value)));
    // Some place in reach, so that there are turning points.
    const Replacement there{x_, graph_->number(Number::real(values_.value(x).value))};
    numbers.back() = substitute(potential_, {&there, 1});
    trial.set(constants_, numbers);
    trial.set({x_}, {x});
    trial.vanishes(terms_of(left));
    return trial.passes();
  }

  std::shared_ptr<const Statics> statics_;
  std::shared_ptr<Graph> graph_;
  ExactValues values_;
  const TurningPoints& found_;
  Expression x_;
  bool is_angle_;
  std::vector<Replacement> start_;
  std::vector<std::string> assumed_;   ///< "theta(0) = pi/6"
  std::vector<Expression> constants_;  ///< p_c and h as symbols, which have values
  Expression energy_symbol_;           ///< h
  bool by_constants_{};                ///< h is the name of no parameter
  Expression potential_, inertia_;     ///< U(x; p) and A(x; p)
  std::vector<Replacement> momenta_;   ///< p_c, by the parameters
  std::optional<Expression> energy_;   ///< h, by the parameters
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
