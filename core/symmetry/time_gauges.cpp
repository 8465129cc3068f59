#include "core/symmetry/time_gauges.hpp"

#include <algorithm>
#include <optional>

#include "core/expr/polynomial.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_functions = 6;

class TimeGauges {
 public:
  explicit TimeGauges(const Lagrangian& lagrangian)
      : lagrangian_(lagrangian), graph_(*lagrangian.graph), t_(lagrangian.symbols.t) {
    for (const auto* group : {&lagrangian.symbols.coordinates, &lagrangian.symbols.inputs}) {
      for (const auto* symbols : {&group->value, &group->rate, &group->second_rate})
        moving_.insert(moving_.end(), symbols->begin(), symbols->end());
    }
  }

  [[nodiscard]] std::vector<ElementaryChange> found() {
    for (const Expression& q : lagrangian_.symbols.coordinates.value) {
      const Expression slope = differentiate(lagrangian_.lagrangian, q);
      if (!depends_on(slope, t_)) continue;
      for (const auto& term : multiplied_out(slope)) take(term.first);
    }
    return std::move(changes_);
  }

 private:
  /// A term that depends on the time by one atom alone.
  void take(const Monomial& monomial) {
    std::optional<Atom> by_time;
    for (const Atom& atom : monomial) {
      const Expression base(graph_, atom.base);
      if (depends_on(base, moving_) || (by_time && depends_on(base, t_))) return;
      if (depends_on(base, t_)) by_time = atom;
    }
    if (!by_time) return;
    const Expression base(graph_, by_time->base);
    const Number exponent = Number::ratio(by_time->p, by_time->q);
    const Expression g = pow(base, exponent);
    if (functions_.size() == most_functions || std::ranges::find(functions_, g) != functions_.end()) return;
    functions_.push_back(g);
    const bool is_call = std::holds_alternative<Call>(base.node());
    if (is_call && exponent.is_one()) take_call(std::get<Call>(base.node()));
    if (!is_call) take_power(base, exponent);
  }

  /// sin, cos or exp of u = a t + b; f is the integral over u and F that of f.
  void take_call(const Call& call) {
    const Expression u(graph_, call.argument), a = differentiate(u, t_);
    if (depends_on(a, t_)) return;
    const auto of_u = [&](Function function) { return graph_.call(function, u); };
    const auto put = [&](const Expression& f, const Expression& second) {
      add(f / a);
      add(t_ * f / a - second / (a * a));
    };
    if (call.function == Function::sin) put(-of_u(Function::cos), -of_u(Function::sin));
    if (call.function == Function::cos) put(of_u(Function::sin), -of_u(Function::cos));
    if (call.function == Function::exp) put(of_u(Function::exp), of_u(Function::exp));
  }

  /// u^n of u = a t + b.
  void take_power(const Expression& u, const Number& n) {
    const Expression a = differentiate(u, t_);
    if (depends_on(a, t_)) return;
    const auto integral = [&](const Number& exponent) {
      const Number next = exponent + Number(1), half = Number::ratio(1, 2);
      if (!next.is_zero()) return pow(u, next) / (next * a);
      return half * graph_.call(Function::log, pow(u, Number(2))) / a;  // of u < 0, too
    };
    const bool is_listed = n.is_one();
    if (!is_listed) add(integral(n));
    // a t u^n = u^(n+1) - b u^n; where b = 0 it is one power.
    const Expression b = expand(u - a * t_), second = integral(n + Number(1)) / a;
    add(b.is_zero() ? second : second - b / a * integral(n));
  }

  void add(const Expression& gauge) {
    const Expression zero = graph_.number(0);
    const std::size_t n = lagrangian_.symbols.coordinates.value.size();
    changes_.push_back({ChangeKind::gauge, n, n, {std::vector<Expression>(n, zero), zero, gauge}});
  }

  const Lagrangian& lagrangian_;
  Graph& graph_;
  Expression t_;
  std::vector<Expression> moving_, functions_;
  std::vector<ElementaryChange> changes_;
};

}  // namespace

std::vector<ElementaryChange> gauges_of_time(const Lagrangian& lagrangian) {
  if (!depends_on(lagrangian.lagrangian, lagrangian.symbols.t)) return {};
  return TimeGauges(lagrangian).found();
}

}  // namespace qdot
