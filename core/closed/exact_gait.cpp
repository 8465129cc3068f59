#include "core/closed/exact_gait.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// One coordinate, and what of the scene speaks of it alone where parameters that are 0 have gone.
class OneCoordinate {
 public:
  OneCoordinate(const ExactValues& values, std::size_t i) : values_(values), graph_(*values.graph()) {
    const Model& model = values.model();
    for (std::size_t k = 0; k < values.symbols().size(); ++k) {
      if (values.is_zero(k)) zeros_.emplace_back(values.symbols()[k], graph_.number(0));
    }
    const Symbols::Varying& q = model.parsed.symbols.coordinates;
    q_ = graph_.adopt(q.value[i]);
    v_ = graph_.adopt(q.rate[i]);
    for (std::size_t k = 0; k < q.value.size(); ++k) {
      if (k == i) continue;
      others_.push_back(graph_.adopt(q.value[k]));
      others_.push_back(graph_.adopt(q.rate[k]));
    }
    others_.push_back(graph_.adopt(model.parsed.symbols.t));
  }

  [[nodiscard]] const Expression& q() const { return q_; }

  /// Whether L does not speak of others, nor its inertia of v.
  bool has_energy() {
    const Model& model = values_.model();
    const Expression l = alone(model.lagrangian.lagrangian);
    for (const Expression& force : model.lagrangian.generalized_forces)
      if (!alone(force).is_zero()) return false;
    inertia_ = simplify(differentiate(differentiate(l, v_), v_));
    potential_ = -at_rest(l);
    return !depends_on(l, others_) && !depends_on(inertia_, v_);
  }

  /// Whether the impact's place and c are known by q alone.
  bool has_impact() {
    Expression after = q_, rate = v_;
    for (const auto& [symbol, value] : values_.model().parsed.impacts.front().map) {
      if (graph_.adopt(symbol) == q_) after = alone(value);
      if (graph_.adopt(symbol) == v_) rate = alone(value);
    }
    factor_ = simplify(differentiate(rate, v_));
    const bool is_linear = simplify(rate - factor_ * v_).is_zero() && !depends_on(factor_, v_);
    if (!is_linear || depends_on(after, v_) || depends_on(after, others_) || depends_on(rate, others_))
      return false;
    return find_places(after);
  }

  /// m - c^2 m': zero where an impact leaves the energy as it is, so that every speed repeats.
  [[nodiscard]] Expression loss() const {
    const Expression c = at(factor_, before_);
    return simplify(at(inertia_, before_) - c * c * at(inertia_, after_));
  }

  [[nodiscard]] Expression square_after() const {
    const Expression c = at(factor_, before_);
    const Expression falls = simplify(graph_.number(2) * (at(potential_, after_) - at(potential_, before_)));
    return c * c * simplify_quotient(falls, loss());
  }

  /// Whether it goes on in the same direction, from a place that the parameters tell.
  [[nodiscard]] bool has_to_come_over() const {
    return !depends_on(square_after(), q_) && values_.sign(at(factor_, before_)) > 0;
  }

  [[nodiscard]] Expression multiplier() const {
    const Expression c = at(factor_, before_);
    return simplify(c * c * at(inertia_, after_) / at(inertia_, before_));
  }

 private:
  [[nodiscard]] Expression alone(const Expression& e) const {
    return simplify(substitute(graph_.adopt(e), zeros_));
  }
  [[nodiscard]] Expression at_rest(const Expression& e) const {
    const Replacement rest{v_, graph_.number(0)};
    return simplify(substitute(e, {&rest, 1}));
  }
  [[nodiscard]] Expression at(const Expression& e, const Expression& place) const {
    const Replacement there{q_, place};
    return substitute(e, {&there, 1});
  }

  /// From what is linear in q: the event, else what the impact makes of q.
  bool find_places(const Expression& after) {
    const Model& model = values_.model();
    const auto& events = model.scene.events;
    const auto event = std::ranges::find(events, model.parsed.impacts.front().event, &SceneEvent::name);
    const Expression surface =
        alone(model.parsed.events[static_cast<std::size_t>(event - events.begin())].value);
    if (!depends_on(surface, others_) && !depends_on(surface, v_)) {
      const auto zero = solved(surface);
      if (!zero) return false;
      before_ = *zero;
      after_ = simplify(at(after, before_));
      return true;
    }
    const Expression place = graph_.symbol("place after the impact");
    const auto zero = solved(after - place);
    if (!zero) return false;
    before_ = at_symbol(*zero, place);
    after_ = q_;
    return true;
  }

  /// Where e, linear in q, is 0.
  [[nodiscard]] std::optional<Expression> solved(const Expression& e) const {
    const Expression slope = simplify(differentiate(e, q_));
    if (slope.is_zero() || depends_on(slope, q_)) return std::nullopt;
    return simplify(-at(e, graph_.number(0)) / slope);
  }
  [[nodiscard]] Expression at_symbol(const Expression& e, const Expression& symbol) const {
    const Replacement named{symbol, q_};
    return substitute(e, {&named, 1});
  }

  const ExactValues& values_;
  Graph& graph_;
  std::vector<Replacement> zeros_;
  Expression q_, v_;
  std::vector<Expression> others_;
  Expression inertia_, potential_, factor_, before_, after_;
};

/// The shortest that agrees with the number; a product as it comes, cos(x)^2/sin(x)^2, rather than a sum that
/// is hardly shorter, 1/sin(x)^2 - 1.
std::optional<ClosedForm> formula(const ExactValues& values, const Expression& e, const Expression& q,
                                  double number, double error) {
  if (!agrees(values.value(e), number, error)) return std::nullopt;
  std::optional<ClosedForm> best;
  for (const Relations& relations : {values.relations(), Relations{}}) {
    const Expression plain = substitute(e, relations.replacements), other = simplify(plain);
    const bool is_shorter = 3 * written_length(other) < 2 * written_length(plain);
    auto form = closed_form(values, is_shorter ? other : plain, relations, {&q, 1});
    if (form && (!best || form->text.size() < best->text.size())) best = std::move(form);
  }
  return best;
}

std::optional<ExactGait> gait_along(const Dynamics& dynamics, const Reals& parameters,
                                    const WrittenTexts& written, const GaitNumbers& found, std::size_t i) {
  const Model& model = dynamics.model();
  ExactValues values(model, std::make_shared<Graph>(*model.parsed.graph), written, parameters);
  OneCoordinate one(values, i);
  if (!one.has_energy() || !one.has_impact() || one.loss().is_zero()) return std::nullopt;
  const std::size_t n = model.degrees_of_freedom();
  values.set(one.q(), {found.state[i], 0, found.errors[i]});
  const double rate = found.state[n + i], error = found.errors[n + i];
  auto square =
      formula(values, one.square_after(), one.q(), rate * rate, (2 * std::abs(rate) + error) * error);
  if (!square) return std::nullopt;
  if (one.has_to_come_over())
    square->assumes.push_back(model.scene.coordinates[i].name + "_dot keeps its sign from impact to impact");
  ExactGait result{i, std::move(*square), std::nullopt};
  const Expression multiplier = one.multiplier();
  for (std::size_t k = 0; k < found.multipliers.size() && !result.multiplier; ++k) {
    if (found.multipliers[k].imag() == 0) {
      result.multiplier =
          formula(values, multiplier, one.q(), found.multipliers[k].real(), found.multiplier_errors[k]);
    }
  }
  return result;
}

}  // namespace

std::optional<ExactGait> exact_gait(const Dynamics& dynamics, const Reals& parameters,
                                    const WrittenTexts& written, const GaitNumbers& found) try {
  const WorkScope scope(most_algebra);
  for (std::size_t i = 0; i < dynamics.model().degrees_of_freedom(); ++i) {
    if (auto gait = gait_along(dynamics, parameters, written, found, i)) return gait;
  }
  return std::nullopt;
} catch (const Error& error) {
  if (error.code() != ErrorCode::too_large) throw;
  return std::nullopt;
}

}  // namespace qdot
