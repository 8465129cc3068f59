#include "core/closed/rolling_forms.hpp"

#include <algorithm>

#include "core/closed/mode_options.hpp"
#include "core/closed/rolling_departures.hpp"
#include "core/dynamics/specialization.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/friction.hpp"

namespace qdot {
namespace {

/// Beyond this eigenvalues have no formulas that are read.
constexpr std::size_t largest_block = 5;

/// The eigenvalues of a block as modes.
class RollingRates {
 public:
  RollingRates(const ExactValues& values, std::vector<Expression> given)
      : values_(values), graph_(*values.graph()), given_(std::move(given)), signs_(values, none_, given_) {}

  void add(std::vector<RationalFunction> c) {
    while (c.size() > 1 && c.front().is_zero()) c.erase(c.begin());
    if (c.size() == 2) creeping(written(Surd(c[0])));
    if (c.size() == 3) of_quadratic(c[0], c[1]);
    if (c.size() != 5 || !c[1].is_zero() || !c[3].is_zero()) return;
    for (const Surd& lambda : quadratic_roots(c[4], -c[2], c[0])) {
      const Expression e = plain_expression(graph_, lambda), of_e = to_expression(graph_, c[2]);
      of_square(lambda, {to_expression(graph_, c[4]) * e * e, -(of_e * e), to_expression(graph_, c[0])});
    }
  }
  [[nodiscard]] const std::vector<ModeForms>& found() const { return found_; }

 private:
  [[nodiscard]] Expression written(const Surd& x) const {
    const Expression plain = to_expression(graph_, x), joined = simplify(plain);
    return written_length(joined) < written_length(plain) ? joined : plain;
  }

  [[nodiscard]] std::optional<ClosedForm> formula(const Expression& e) const {
    auto form = closed_form(values_, e, {}, given_);
    if (form) assume_signs(*form, values_, e, given_);
    return form;
  }

  using Terms = std::vector<Expression>;

  /// With what has to be assumed for these to be positive, and for the terms to vanish.
  void take(ModeForms mode, const std::vector<Expression>& positive, const Terms& vanishing) {
    Trial trial(values_, none_);
    for (const Expression& e : positive) trial.is_positive(e);
    if (!vanishing.empty()) trial.vanishes(vanishing);
    if (signs_.are_there()) add_conditions(signs_.needed_for(trial), mode.form);
    found_.push_back(std::move(mode));
  }

  [[nodiscard]] Expression root_of(const Surd& square) const {
    const Expression without_squares =
        square.is_rational() ? positive_root(graph_, square.p, values_.sign_of())
                             : positive_root(graph_, square, root_form(graph_, square.n), values_.sign_of());
    const Expression whole = sqrt(written(square));
    return written_length(whole) < written_length(without_squares) ? whole : without_squares;
  }

  /// s^2 + b s + c.
  void of_quadratic(const RationalFunction& c, const RationalFunction& b) {
    if (b.is_zero()) return of_square(Surd(c));
    const RationalFunction half = rational_function(graph_.number(Number::ratio(1, 2)));
    const Surd decay(half * b), square(c - decay.p * decay.p);
    const Expression rate = written(decay);
    const int sign = values_.sign(written(square));
    if (sign > 0) swinging(square, rate);
    if (sign >= 0) return;
    const Expression root = root_of(-square);
    for (const int side : {1, -1}) creeping(rate + Number(side) * root);
  }

  /// s^2 = -lambda, where the terms say of lambda what it is.
  void of_square(const Surd& lambda, const Terms& vanishing = {}) {
    const int sign = values_.sign(plain_expression(graph_, lambda));
    if (sign == 0) return;
    const Surd square = sign > 0 ? lambda : -lambda;
    const Expression root = root_of(square);
    if (sign > 0) return undamped(square, root, vanishing);
    creeping(root, vanishing);
    creeping(-root, vanishing);
  }

  void undamped(const Surd& square, const Expression& root, const Terms& vanishing) {
    auto of_square = formula(written(square));
    const auto of_root = formula(root);
    if (!of_square) return;
    const auto period = formula(Number(2) * graph_.symbol("pi") / root);
    take({root, true, {.square = *std::move(of_square), .rate = of_root, .period = period}, {}, {}}, {root},
         vanishing);
  }

  void swinging(const Surd& square, const Expression& decay) {
    const Expression omega = root_of(square);
    const int sign = values_.sign(decay);
    const Expression rate = sign < 0 ? -decay : decay;
    auto of_square = formula(written(square));
    const auto of_omega = formula(omega), of_rate = formula(rate);
    if (sign == 0 || !of_square || !of_omega || !of_rate) return;
    take({omega, true, {.square = *std::move(of_square), .rate = of_omega, .damping = of_rate}, {}, decay},
         {omega, rate}, {});
  }

  void creeping(const Expression& decay, const Terms& vanishing = {}) {
    const int sign = values_.sign(decay);
    const Expression size = sign < 0 ? -decay : decay;
    auto form = formula(size);
    if (sign != 0 && form)
      take({size, false, {.square = *std::move(form), .creeps = true}, {}, decay}, {size}, vanishing);
  }

  const ExactValues& values_;
  Graph& graph_;
  const Relations none_;
  std::vector<Expression> given_;
  AssumedSigns signs_;
  std::vector<ModeForms> found_;
};

RationalRows part_of(const RationalRows& a, const std::vector<std::size_t>& block) {
  RationalRows part;
  for (const std::size_t i : block) {
    part.emplace_back();
    for (const std::size_t j : block) part.back().push_back(a[i][j]);
  }
  return part;
}

/// Of four or more rows only where the rates cancel in pairs.
bool may_have_formulas(const RationalRows& block) {
  if (block.size() < 4) return true;
  RationalFunction trace;
  for (std::size_t i = 0; i < block.size(); ++i) trace = trace + block[i][i];
  return block.size() <= largest_block && trace.is_zero();
}

}  // namespace

std::vector<std::optional<ExactMode>> rolling_forms(const Model& model, const Reals& parameters,
                                                    const WrittenTexts& written, const Modes& found) {
  std::vector<std::optional<ExactMode>> result(found.modes.size());
  if (!model.scene.inputs.empty() || has_forces_of_multipliers(model.lagrangian)) return result;
  const Lagrangian own = specialized(model, {}, vanishing_among(parameters));
  ExactValues values(model, own.graph, written, parameters);
  for (const GivenRates given : {GivenRates::as_written, GivenRates::as_symbols}) {
    const RollingDepartures departures = rolling_departures(own, values, found, given);
    const RationalRows& r = departures.matrix;
    RollingRates rates(values, departures.given);
    for (const auto& block : blocks_of(r)) {
      const RationalRows part = part_of(r, block);
      if (may_have_formulas(part)) rates.add(characteristic_polynomial(part));
    }
    for (std::size_t i = 0; i < found.modes.size(); ++i) {
      if (const ModeForms* option = option_of_mode(rates.found(), found.modes[i], values))
        result[i] = option->form;
    }
    if (!r.empty()) break;
  }
  return result;
}

}  // namespace qdot
