#include <algorithm>
#include <array>

#include "core/closed/assumed_signs.hpp"

namespace qdot {

std::vector<Expression> inside_domain(const Domain& domain, const Expression& x) {
  std::vector<Expression> positive;
  if (domain.lower == 0) positive.push_back(x);
  if (domain.upper == 0) positive.push_back(-x);
  return positive;
}

namespace {

/// What changes its sign where forces have kinks.
std::vector<Expression> kinks_of(const LinearMotions& motions) {
  Graph& graph = *motions.graph;
  std::vector<NodeId> roots;
  for (const Expression& force : motions.forces) roots.push_back(force.id());
  std::vector<Expression> kinks;
  for (const NodeId id : reachable(graph, roots)) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr || (call->function != Function::abs && call->function != Function::sign)) continue;
    const Expression inside(graph, call->argument);
    if (depends_on(inside, motions.x)) kinks.push_back(inside);
  }
  return kinks;
}

/// What forces take even roots and logarithms of: elsewhere they have no value, even where they would vanish.
std::vector<Expression> taken_roots_of(const LinearMotions& motions) {
  Graph& graph = *motions.graph;
  std::vector<NodeId> forces;
  for (const Expression& force : motions.forces) forces.push_back(force.id());
  std::vector<Expression> taken_of;
  for (const NodeId id : reachable(graph, forces)) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (power != nullptr && (power->exponent.denominator() / Number(2)).is_integer())
      taken_of.emplace_back(graph, power->base);
    else if (call != nullptr && call->function == Function::log)
      taken_of.emplace_back(graph, call->argument);
  }
  std::erase_if(taken_of, [&](const Expression& e) { return !depends_on(e, motions.x); });
  return taken_of;
}

/// That h^2 > 4 a^2 is told as h > 2 a, which takes both to be positive: of parameters that the place itself
/// does not speak of.
std::vector<std::string> signs_under(const std::vector<Expression>& taken_of, const ExactPlace& place,
                                     const ExactValues& values) {
  std::vector<std::string> signs;
  const auto is_told = [&](const Expression& p) {
    return std::ranges::any_of(taken_of, [&](const Expression& e) {
      return std::holds_alternative<Sum>(e.node()) && depends_on(e, p);
    });
  };
  for (std::size_t i = 0; i < values.symbols().size(); ++i) {
    const Expression& p = values.symbols()[i];
    const Parameter& parameter = values.model().scene.parameters[i];
    const bool is_said =
        std::ranges::any_of(place.x(), [&](const Expression& x) { return depends_on(x, p); });
    const double value = values.parameters()[i];
    if (!is_told(p) || is_said || value == 0 || !parameter.domain.contains(-value)) continue;
    signs.push_back(parameter.name + (value < 0 ? " < 0" : " > 0"));
  }
  return signs;
}

}  // namespace

std::vector<std::string> assumed_at(const LinearMotions& motions, const ExactPlace& place,
                                    const ExactValues& values) {
  std::vector<Expression> given = place.undecided();
  given.insert(given.end(), motions.momenta.begin(), motions.momenta.end());
  const Relations none;
  AssumedSigns signs(values, none, given);
  std::vector<Expression> inside;
  for (std::size_t k = 0; k < motions.moving.size(); ++k) {
    const Domain& domain = values.model().scene.coordinates[motions.moving[k]].domain;
    for (const Expression& e : inside_domain(domain, motions.x[k])) {
      inside.push_back(e);
      signs.ask(substitute(e, std::array{Replacement{motions.x[k], place.x()[k]}}));
    }
  }
  for (const Expression& kink : kinks_of(motions)) {
    std::vector<Replacement> there;
    for (std::size_t k = 0; k < motions.x.size(); ++k) there.emplace_back(motions.x[k], place.x()[k]);
    signs.ask(substitute(kink, there));
  }
  std::vector<Expression> taken_of;
  for (const Expression& each : taken_roots_of(motions)) taken_of.push_back(place.at(each));
  for (const Expression& each : taken_of) signs.ask(each);
  for (const Expression& x : place.x()) signs.ask_for_value_of(x);
  if (!signs.are_there()) return {};
  Trial trial(values, none);
  for (const Expression& e : inside) trial.is_positive(e);
  trial.set_given(given);
  trial.set(motions.x, place.x());
  for (const auto* vanishing : {&motions.forces, &motions.surface}) {
    for (const Expression& e : *vanishing) trial.vanishes({e});
  }
  if (motions.stiffness.size() == 1) {
    const Expression& stiffness = motions.stiffness[0][0];
    trial.is_positive(values.value(stiffness).value < 0 ? -stiffness : stiffness);
  }
  std::vector<std::string> needed = signs.needed_for(trial);
  if (needed.empty()) return needed;
  const std::vector<std::string> under = signs_under(taken_of, place, values);
  needed.insert(needed.begin(), under.begin(), under.end());
  return needed;
}

}  // namespace qdot
