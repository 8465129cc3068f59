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
  return signs.needed_for(trial);
}

}  // namespace qdot
