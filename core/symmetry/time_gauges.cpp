#include "core/symmetry/time_gauges.hpp"

#include <algorithm>

#include "core/expr/polynomial.hpp"
#include "core/mechanics/friction.hpp"
#include "core/symmetry/antiderivative.hpp"

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
    const std::vector<Expression> forces = working_forces(lagrangian_);
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const Expression& q = lagrangian_.symbols.coordinates.value[i];
      const Expression slope = differentiate(lagrangian_.lagrangian, q) + forces[i];
      if (!depends_on(slope, t_)) continue;
      for (const auto& term : multiplied_out(slope)) take(term.first);
    }
    return std::move(changes_);
  }

 private:
  /// A term that depends on the time, and on nothing that moves.
  void take(const Monomial& monomial) {
    Monomial by_time;
    for (const Atom& atom : monomial) {
      const Expression base(graph_, atom.base);
      if (depends_on(base, moving_)) return;
      if (depends_on(base, t_)) by_time.push_back(atom);
    }
    const Expression g = to_expression(graph_, by_time);
    if (by_time.empty() || functions_.size() == most_functions ||
        std::ranges::find(functions_, g) != functions_.end())
      return;
    functions_.push_back(g);
    if (const auto f = antiderivative(g, t_)) add(*f);
    if (const auto second = antiderivative(t_ * g, t_)) add(*second);
  }

  /// t and t^2 are elementary changes already.
  void add(const Expression& gauge) {
    const Number* second = differentiate(differentiate(gauge, t_), t_).number();
    const auto is_it = [&](const ElementaryChange& change) { return change.change.gauge == gauge; };
    if (second != nullptr || std::ranges::any_of(changes_, is_it)) return;
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
  const auto is_timed = [&](const Expression& e) { return depends_on(e, lagrangian.symbols.t); };
  if (!is_timed(lagrangian.lagrangian) && std::ranges::none_of(working_forces(lagrangian), is_timed))
    return {};
  return TimeGauges(lagrangian).found();
}

}  // namespace qdot
