#include "core/symmetry/point_change.hpp"

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class ChangeList {
 public:
  explicit ChangeList(const Lagrangian& lagrangian)
      : graph_(*lagrangian.graph), symbols_(lagrangian.symbols), zero_(graph_.number(0)) {}

  void add(ChangeKind kind, std::size_t i, std::size_t j, const Expression& value) {
    const std::size_t n = symbols_.coordinates.value.size();
    PointChange change{std::vector<Expression>(n, zero_), zero_, zero_};
    switch (kind) {
      case ChangeKind::gauge:
        change.gauge = value;
        break;
      case ChangeKind::time:
        change.time = value;
        break;
      case ChangeKind::shift:
      case ChangeKind::boost:
      case ChangeKind::linear:
      case ChangeKind::along:
      case ChangeKind::turn:
      case ChangeKind::own_turn:
        change.shift[i] = value;
        break;
    }
    changes.push_back({kind, i, j, std::move(change)});
  }

  /// z_i and z_i z_j of the coordinates and the time.
  void add_gauges() {
    std::vector<Expression> z = symbols_.coordinates.value;
    z.push_back(symbols_.t);
    for (std::size_t i = 0; i < z.size(); ++i) {
      add(ChangeKind::gauge, i, i, z[i]);
      for (std::size_t j = i; j < z.size(); ++j) add(ChangeKind::gauge, i, j, z[i] * z[j]);
    }
  }

  std::vector<ElementaryChange> changes;

 private:
  Graph& graph_;
  const Symbols& symbols_;
  Expression zero_;
};

/// dL/dt where it is explicit: by t, and by inputs, which are functions of it.
Expression explicit_rate(const Lagrangian& lagrangian) {
  const Symbols& symbols = lagrangian.symbols;
  std::vector<Expression> terms{differentiate(lagrangian.lagrangian, symbols.t)};
  const Symbols::Varying& inputs = symbols.inputs;
  for (std::size_t k = 0; k < inputs.value.size(); ++k) {
    terms.push_back(inputs.rate[k] * differentiate(lagrangian.lagrangian, inputs.value[k]));
    terms.push_back(inputs.second_rate[k] * differentiate(lagrangian.lagrangian, inputs.rate[k]));
  }
  return lagrangian.graph->sum(terms);
}

}  // namespace

std::vector<ElementaryChange> elementary_changes(const Lagrangian& lagrangian,
                                                 const std::vector<bool>& ignorable, bool time_is_known) {
  const std::vector<Expression>& q = lagrangian.symbols.coordinates.value;
  const Expression one = lagrangian.graph->number(1);
  ChangeList list(lagrangian);
  list.add_gauges();
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (!ignorable[i]) list.add(ChangeKind::shift, i, i, one);
  }
  for (std::size_t i = 0; i < q.size(); ++i) list.add(ChangeKind::boost, i, i, lagrangian.symbols.t);
  for (std::size_t i = 0; i < q.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) list.add(ChangeKind::linear, i, j, q[j]);
  }
  if (!time_is_known) list.add(ChangeKind::time, 0, 0, one);
  return std::move(list.changes);
}

PointChange combination(Graph& graph, std::span<const Expression> coefficients,
                        std::span<const ElementaryChange> changes) {
  const Expression zero = graph.number(0);
  PointChange sum{std::vector<Expression>(changes[0].change.shift.size(), zero), zero, zero};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    if (coefficients[k].is_zero()) continue;
    const PointChange& change = changes[k].change;
    for (std::size_t i = 0; i < sum.shift.size(); ++i)
      sum.shift[i] = sum.shift[i] + coefficients[k] * change.shift[i];
    sum.time = sum.time + coefficients[k] * change.time;
    sum.gauge = sum.gauge + coefficients[k] * change.gauge;
  }
  return sum;
}

Variation::Variation(const Lagrangian& lagrangian, std::vector<Replacement> on_constraints)
    : graph_(*lagrangian.graph), on_constraints_(std::move(on_constraints)) {
  const Symbols& symbols = lagrangian.symbols;
  const Symbols::Varying& q = symbols.coordinates;
  std::vector<Expression> power{explicit_rate(lagrangian)};
  for (std::size_t i = 0; i < q.value.size(); ++i) {
    const Expression& force = lagrangian.generalized_forces[i];
    rates_.emplace_back(q.value[i], q.rate[i]);
    slopes_.push_back(differentiate(lagrangian.lagrangian, q.value[i]) + force);
    momenta_.push_back(differentiate(lagrangian.lagrangian, q.rate[i]));
    power.push_back(-(force * q.rate[i]));
  }
  rates_.emplace_back(symbols.t, graph_.number(1));
  for (std::size_t j = 0; j < lagrangian.constraints.size(); ++j)
    power.push_back(symbols.multipliers[j] * lagrangian.constraints[j].rate);
  power_ = graph_.sum(power);
}

Expression Variation::operator()(const PointChange& change) const {
  std::vector<Expression> terms{change.time * power_, -total_derivative(change.gauge, rates_)};
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    if (change.shift[i].is_zero()) continue;
    terms.push_back(slopes_[i] * change.shift[i]);
    terms.push_back(momenta_[i] * total_derivative(change.shift[i], rates_));
  }
  return substitute(graph_.sum(terms), on_constraints_);
}

Expression noether_quantity(const Lagrangian& lagrangian, const PointChange& change) {
  const std::vector<Expression> momenta = conjugate_momenta(lagrangian);
  std::vector<Expression> terms{-change.gauge};
  for (std::size_t i = 0; i < momenta.size(); ++i) terms.push_back(momenta[i] * change.shift[i]);
  if (change.time.is_zero()) return simplify_by_degree(lagrangian.graph->sum(terms), lagrangian.symbols);
  const Expression rest = -lagrangian.graph->sum(terms);
  return change.time * jacobi_integral(lagrangian) + simplify_by_degree(rest, lagrangian.symbols);
}

}  // namespace qdot
