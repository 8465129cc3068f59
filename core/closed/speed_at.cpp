#include "core/closed/speed_at.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/compile/tape_builder.hpp"

namespace qdot {
namespace {

/// Whether anything in e that depends on x may grow without bound at a place: a quotient, a tangent or a
/// logarithm, but not what is divided by exp or cosh.
bool may_have_poles(const Expression& e, const Expression& x) {
  const Graph& graph = e.graph();
  const NodeId root = e.id();
  return std::ranges::any_of(reachable(graph, {&root, 1}), [&](NodeId id) {
    if (!depends_on(Expression(e.graph(), id), x)) return false;
    if (const auto* call = std::get_if<Call>(&graph.node(id)))
      return call->function == Function::tan || call->function == Function::log;
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr || !power->exponent.is_negative()) return false;
    const auto* call = std::get_if<Call>(&graph.node(power->base));
    return call == nullptr || (call->function != Function::exp && call->function != Function::cosh);
  });
}

}  // namespace

bool is_heavy(const QuadratureProblem& problem, double x, FarPlace far) {
  far.emplace_back(problem.x, Real(x));
  return rough_value(problem.inertia, far) > 0;
}

SpeedAt::SpeedAt(const QuadratureProblem& problem, const FarPlace& like) {
  std::vector<Expression> symbols;
  for (const auto& [symbol, value] : like) symbols.push_back(symbol);
  Graph& graph = problem.x.graph();
  TapeBuilder tape(graph, symbols, graph.symbol("t"), {&problem.x, 1});
  const Expression squared_speed = Number(2) * (problem.energy - problem.potential) / problem.inertia;
  tape.output(squared_speed);
  may_have_poles_ = may_have_poles(squared_speed, problem.x);
  function_ = tape.finish();
  barriers_.emplace(problem.inertia, problem.x, symbols);
}

SquaredSpeed SpeedAt::at(const FarPlace& place) const {
  const auto known = [](double e) { return std::isfinite(e) ? e : std::numeric_limits<double>::quiet_NaN(); };
  std::vector<double> numbers;
  for (const auto& [symbol, value] : place) numbers.push_back(value.value);
  const Workspace bound = function_.bind(numbers);
  SquaredSpeed speed;
  speed.may_have_poles = may_have_poles_;
  speed.at = [this, known, workspace = bound](double x) mutable {
    double e = 0;
    (void)function_.evaluate(0, {&x, 1}, workspace, {&e, 1});
    return known(e);
  };
  speed.meets_barrier = barriers_->at(numbers);
  PairWorkspace pairs;
  for (const double number : bound) pairs.push_back(PairOfDoubles{number, number});
  speed.at_both = [this, known, workspace = std::move(pairs)](double x, double y) mutable {
    const PairOfDoubles places{x, y};
    PairOfDoubles e{};
    (void)function_.evaluate(0, {&places, 1}, workspace, {&e, 1});
    return std::array{known(e[0]), known(e[1])};
  };
  return speed;
}

}  // namespace qdot
