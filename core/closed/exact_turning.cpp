#include "core/closed/exact_turning.hpp"

#include <algorithm>
#include <string_view>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/exact_roots.hpp"
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
               const TurningPoints& found)
      : statics_(dynamics.statics(parameters)),
        graph_(std::make_shared<Graph>(*statics_->reduction.graph)),
        values_(dynamics.model(), graph_, written, parameters),
        found_(found),
        x_(graph_->adopt(statics_->reduction.x[0])),
        is_angle_(dynamics.model().scene.coordinates[found.coordinate].unit == "rad") {}

  ExactTurningPoints forms() {
    ExactTurningPoints result;
    if (!take_initial_state()) return result;
    const Expression balance = energy_balance();
    if (found_.energy.value)
      result.energy = constant(simplify(energy_), *found_.energy.value, found_.energy.error);
    for (std::size_t c = 0; c < momenta_.size(); ++c)
      result.momenta.push_back(constant(momenta_[c].second, found_.momenta[c], found_.momenta_errors[c]));
    std::size_t length = 0;
    for (const Relations& relations : {values_.relations(), Relations{}}) {
      const Expression left = divided(substitute(balance, relations.replacements));
      if (left.is_zero() || !depends_on(left, x_)) return {};
      const auto form = formula(left, relations, {&x_, 1});
      const bool better = form && (!result.equation || written_length(left) < length);
      if (better) {
        length = written_length(left);
        result.equation = with_zero(*form);
      }
      consider(found_.maximum, left, relations, result.maximum);
      consider(found_.minimum, left, relations, result.minimum);
    }
    return result;
  }

 private:
  static ClosedForm with_zero(ClosedForm form) {
    form.text += " = 0";
    form.latex += " = 0";
    return form;
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

  /// With what was put in for the initial state.
  [[nodiscard]] std::optional<ClosedForm> formula(const Expression& e, const Relations& relations,
                                                  std::span<const Expression> allowed = {}) const {
    auto form = closed_form(values_, e, relations, allowed);
    if (form) form->assumes.insert(form->assumes.end(), assumed_.begin(), assumed_.end());
    return form;
  }

  [[nodiscard]] Expression at_start(const Expression& e) const {
    return with_special_angles(substitute(e, start_));
  }

  /// U(x; p) - U(x0; p) - 1/2 A(x0) x0'^2 with p of the initial state.
  [[nodiscard]] Expression energy_balance() {
    const Reduction& reduction = statics_->reduction;
    const Expression rate = graph_->adopt(reduction.x_dot[0]);
    const Replacement rest{rate, graph_->number(0)};
    for (std::size_t c = 0; c < reduction.ignored.size(); ++c) {
      const std::size_t place = reduction.constants.size() - reduction.ignored.size() + c;
      const Expression p = graph_->adopt(values_.model().momenta[reduction.ignored[c]]);
      momenta_.emplace_back(graph_->adopt(reduction.constants[place]), at_start(without_zeros(p)));
    }
    const Expression routhian = substitute(graph_->adopt(reduction.routhian), momenta_);
    const Expression potential = -substitute(routhian, {&rest, 1});
    const Expression inertia = substitute(differentiate(differentiate(routhian, rate), rate), {&rest, 1});
    const Expression kinetic = Number::ratio(1, 2) * inertia * rate * rate;
    energy_ = at_start(potential) + at_start(kinetic);
    return potential - energy_;
  }

  /// A constant of the motion, in the shorter of its forms.
  [[nodiscard]] std::optional<ClosedForm> constant(const Expression& e, double value, double error) const {
    if (!agrees(values_.value(e), value, error)) return std::nullopt;
    const Relations& relations = values_.relations();
    const Expression general = to_expression(*graph_, rational_function(e));
    const Expression related = simplify(substitute(e, relations.replacements));
    if (written_length(related) < written_length(general)) return formula(related, relations);
    return formula(general, {});
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

  void consider(const Finding& extremum, const Expression& left, const Relations& relations,
                std::optional<ExactExtremum>& best) const {
    if (!extremum.value) return;
    for (const Function function : {Function::cos, Function::sin}) {
      const Expression unknown = is_angle_ ? graph_->call(function, x_) : x_;
      for (const Expression& root : roots_in(unknown, left)) {
        auto found =
            is_angle_ ? angle(function, root, extremum, relations) : number(root, extremum, relations);
        if (found && is_root(found->first, left, relations) &&
            (!best || found->second.value.text.size() < best->value.text.size()))
          best = std::move(found->second);
      }
      if (!is_angle_) return;
    }
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
    auto form = formula(root, relations);
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
      for (const Expression& x : {value, function == Function::cos ? -value : pi - value}) {
        if (!agrees(values_.value(x), *extremum.value, extremum.error)) continue;
        auto form = formula(x, relations);
        auto of_function = formula(root, relations);
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
  std::vector<std::string> assumed_;  ///< "theta(0) = pi/6"
  std::vector<Replacement> momenta_;  ///< p_c, by the parameters
  Expression energy_;                 ///< h
};

/// A plain number other than 0.
bool is_decimal(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  const auto number = Number::written(text);
  return number && !number->is_zero();
}

/// Whether the initial state has a velocity or a length in decimals, which leaves no formula.
bool starts_from_decimals(const Scene& scene, const WrittenTexts& written) {
  if (scene.without_units) return false;
  const auto text_of = [&](const std::string& name, const std::string& by_default) -> const std::string& {
    const auto found = written.find(name);
    return found == written.end() ? by_default : found->second;
  };
  return std::ranges::any_of(scene.coordinates, [&](const Coordinate& q) {
    return is_decimal(text_of(q.name + "_dot", q.initial_rate)) ||
           (q.unit != "rad" && is_decimal(text_of(q.name, q.initial)));
  });
}

}  // namespace

ExactTurningPoints exact_turning_points(const Dynamics& dynamics, const Reals& parameters,
                                        const WrittenTexts& written, const TurningPoints& found) {
  if (starts_from_decimals(dynamics.model().scene, written)) return {};
  try {
    const WorkScope budget(most_algebra);
    return TurningForms(dynamics, parameters, written, found).forms();
  } catch (const Error&) {  // the algebra grows too large, or divides by what vanishes
    return {};
  }
}

}  // namespace qdot
