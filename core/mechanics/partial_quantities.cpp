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

/// A tangent of what varies, or a denominator with more in it than one coordinate, which is 0 or is not.
bool may_have_poles(const Expression& e, const std::vector<NodeId>& varying) {
  const Graph& graph = e.graph();
  const auto varies = [&](NodeId id) {
    const auto below = reachable(graph, std::array{id});
    return std::ranges::any_of(varying, [&](NodeId v) { return std::ranges::binary_search(below, v); });
  };
  return std::ranges::any_of(reachable(graph, std::array{e.id()}), [&](NodeId id) {
    if (const auto* call = std::get_if<Call>(&graph.node(id)))
      return call->function == Function::tan && varies(call->argument);
    const auto* power = std::get_if<Power>(&graph.node(id));
    return power != nullptr && power->exponent < Number(0) &&
           !std::holds_alternative<Symbol>(graph.node(power->base)) && varies(power->base);
  });
}

class Collector {
 public:
  Collector(const ParsedScene& scene, const Lagrangian& lagrangian) : lagrangian_(lagrangian) {
    for (const auto* all : {&scene.symbols.coordinates.value, &scene.symbols.coordinates.rate}) {
      for (const Expression& symbol : *all) varying_.push_back(symbol.id());
    }
    all_that_varies_ = {scene.symbols.t};
    for (const auto* all : {&scene.symbols.coordinates, &scene.symbols.inputs}) {
      for (const auto* symbols : {&all->value, &all->rate})
        all_that_varies_.insert(all_that_varies_.end(), symbols->begin(), symbols->end());
    }
  }

  void add(const std::string& name, const Expression& e) {
    const bool poles = may_have_poles(e, varying_);
    if (!poles && !is_partial(e, varying_)) return;
    const Expression held = substitute(e, lagrangian_.holding);
    result_.push_back({name, held, poles, parts_of_parameters(held)});
  }
  void add(const std::string& name, const Vector& vector) {
    for (const Expression& component : vector) add(name, component);
  }

  std::vector<PartialQuantity> result() && { return std::move(result_); }

 private:
  [[nodiscard]] std::vector<Expression> parts_of_parameters(const Expression& e) const {
    const auto may_lose = [](const Power& power) {
      return power.exponent < Number(0) || !power.exponent.is_integer();
    };
    std::vector<Expression> parts;
    for (const NodeId id : reachable(e.graph(), std::array{e.id()})) {
      const Node& node = e.graph().node(id);
      const auto* power = std::get_if<Power>(&node);
      const auto* call = std::get_if<Call>(&node);
      const bool is_partial = (power && may_lose(*power)) || (call && is_partial_function(call->function));
      const Expression part(e.graph(), id);
      if (is_partial && !depends_on(part, all_that_varies_)) parts.push_back(part);
    }
    return parts;
  }

  const Lagrangian& lagrangian_;
  std::vector<Expression> all_that_varies_;  ///< inputs and the time, too
  std::vector<NodeId> varying_;
  std::vector<PartialQuantity> result_;
};

std::vector<RealAssignment> assigned(const Symbols& symbols, const Reals& parameters, double t,
                                     const Reals& y) {
  std::vector<RealAssignment> values;
  const auto assign = [&](const std::vector<Expression>& to, const Reals& from, std::size_t first) {
    for (std::size_t i = 0; i < to.size(); ++i) values.emplace_back(to[i], from.exact(first + i));
  };
  assign(symbols.parameters, parameters, 0);
  assign(symbols.coordinates.value, y, 0);
  assign(symbols.coordinates.rate, y, symbols.coordinates.value.size());
  values.emplace_back(symbols.t, t);
  return values;
}

bool has_value(const PartialQuantity& quantity, std::span<const RealAssignment> values) {
  std::vector<Assignment> doubles;
  for (const auto& [symbol, value] : values) doubles.emplace_back(symbol, value.value);
  return std::isfinite(evaluate(quantity.value, doubles)) &&
         (!quantity.may_have_poles || is_bounded(quantity.value, values));
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
                          const Reals& parameters, std::optional<double> t, const Reals& y) {
  std::string names;
  if (quantities.empty()) return names;
  const std::vector<RealAssignment> values = assigned(symbols, parameters, t.value_or(0), y);
  for (const PartialQuantity& quantity : quantities) {
    if (depends_on(quantity.value, symbols.inputs.value)) continue;
    if (!t && depends_on(quantity.value, symbols.t)) continue;
    if (has_value(quantity, values)) continue;
    if (names.find(quantity.name) != std::string::npos) continue;
    names += (names.empty() ? "" : " and ") + quantity.name;
  }
  return names;
}

std::optional<MissingPart> part_without_value(const std::vector<PartialQuantity>& quantities,
                                              const Symbols& symbols, const Reals& parameters,
                                              std::optional<std::size_t> varied) {
  std::vector<Assignment> values;
  for (std::size_t i = 0; i < symbols.parameters.size(); ++i)
    values.emplace_back(symbols.parameters[i], parameters[i]);
  for (const PartialQuantity& quantity : quantities) {
    for (const Expression& part : quantity.of_parameters) {
      if (varied && depends_on(part, symbols.parameters[*varied])) continue;
      if (!std::isfinite(evaluate(part, values))) return MissingPart{quantity.name, part};
    }
  }
  return std::nullopt;
}

}  // namespace qdot
