#include "core/mechanics/partial_quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace qdot {
namespace {

bool is_partial_function(Function function) {
  return function == Function::log || function == Function::asin || function == Function::acos;
}

/// Differentiating keeps a denominator that varies, and may lose one that does not.
bool may_lose_its_value(const Graph& graph, const Power& power, const std::vector<NodeId>& varying) {
  if (!power.exponent.is_integer()) return true;
  if (!(power.exponent < Number(0))) return false;
  const auto below = reachable(graph, std::array{power.base});
  return std::ranges::none_of(varying, [&](NodeId id) { return std::ranges::binary_search(below, id); });
}

bool is_partial(const Expression& e, const std::vector<NodeId>& varying) {
  const Graph& graph = e.graph();
  const auto partial =
      overloaded{[](const Literal&) { return false; },
                 [](const Symbol&) { return false; },
                 [](const Sum&) { return false; },
                 [](const Product&) { return false; },
                 [&](const Power& power) { return may_lose_its_value(graph, power, varying); },
                 [](const Call& call) { return is_partial_function(call.function); }};
  return std::ranges::any_of(reachable(graph, std::array{e.id()}),
                             [&](NodeId id) { return std::visit(partial, graph.node(id)); });
}

class Collector {
 public:
  Collector(const ParsedScene& scene, const Lagrangian& lagrangian) : lagrangian_(lagrangian) {
    for (const auto* all : {&scene.symbols.coordinates.value, &scene.symbols.coordinates.rate}) {
      for (const Expression& symbol : *all) varying_.push_back(symbol.id());
    }
  }

  void add(const std::string& name, const Expression& e) {
    if (!is_partial(e, varying_)) return;
    result_.push_back({name, substitute(e, lagrangian_.holding)});
  }
  void add(const std::string& name, const Vector& vector) {
    for (const Expression& component : vector) add(name, component);
  }

  std::vector<PartialQuantity> result() && { return std::move(result_); }

 private:
  const Lagrangian& lagrangian_;
  std::vector<NodeId> varying_;
  std::vector<PartialQuantity> result_;
};

double value_of(const PartialQuantity& quantity, const Symbols& symbols, std::span<const double> parameters,
                double t, std::span<const double> y) {
  std::vector<Assignment> values;
  const auto assign = [&](const std::vector<Expression>& to, std::span<const double> from) {
    for (std::size_t i = 0; i < to.size(); ++i) values.emplace_back(to[i], from[i]);
  };
  const std::size_t n = symbols.coordinates.value.size();
  assign(symbols.parameters, parameters);
  assign(symbols.coordinates.value, y);
  assign(symbols.coordinates.rate, y.subspan(n));
  values.emplace_back(symbols.t, t);
  return evaluate(quantity.value, values);
}

}  // namespace

std::vector<PartialQuantity> partial_quantities(const ParsedScene& scene, const Lagrangian& lagrangian) {
  Collector collector(scene, lagrangian);
  collector.add("L", lagrangian.lagrangian);
  for (const ParsedBody& body : scene.bodies) {
    const std::string name = body.name.empty() ? "the position of a body" : "the position of " + body.name;
    collector.add(name, body.centre);
    if (body.angle) collector.add(name, *body.angle);
    for (const Turn& turn : body.turns) collector.add(name, turn.angle);
  }
  for (const ParsedForce& force : scene.forces) collector.add("the place where a force acts", force.point);
  return std::move(collector).result();
}

std::string without_value(const std::vector<PartialQuantity>& quantities, const Symbols& symbols,
                          std::span<const double> parameters, std::optional<double> t,
                          std::span<const double> y) {
  std::string names;
  for (const PartialQuantity& quantity : quantities) {
    if (depends_on(quantity.value, symbols.inputs.value)) continue;
    if (!t && depends_on(quantity.value, symbols.t)) continue;
    if (std::isfinite(value_of(quantity, symbols, parameters, t.value_or(0), y))) continue;
    if (names.find(quantity.name) != std::string::npos) continue;
    names += (names.empty() ? "" : " and ") + quantity.name;
  }
  return names;
}

}  // namespace qdot
