#include "core/grading/inertia_changes.hpp"

#include <algorithm>
#include <array>

namespace qdot {
namespace {

/// dT of each body, and of all.
class InertiaChanges {
 public:
  InertiaChanges(const Model& model, const ExpectedSystem& system) : model_(model), system_(system) {}

  [[nodiscard]] std::vector<Expression> of_energy() const {
    std::vector<Expression> changes;
    for (const ParsedBody& body : model_.parsed.bodies) {
      const Expression change = held(change_of(body));
      if (!change.is_zero()) changes.push_back(change);
    }
    if (changes.size() > 1) changes.push_back(graph().sum(changes));
    return changes;
  }

 private:
  [[nodiscard]] Graph& graph() const { return system_.graph(); }
  [[nodiscard]] Expression change_of(const ParsedBody& body) const {
    std::vector<Expression> terms;
    for (const ParsedSpin& spin : body.spins) {
      const Expression rate = graph().adopt(spin.rate);
      terms.push_back(Number::ratio(1, 2) * (graph().adopt(spin.more_at_end) * rate * rate));
    }
    return graph().sum(terms);
  }

  /// Lengths are held at their values.
  [[nodiscard]] Expression held(const Expression& e) const {
    std::vector<Replacement> holding;
    for (const auto& [symbol, value] : model_.lagrangian.holding)
      holding.emplace_back(graph().adopt(symbol), graph().adopt(value));
    return system_.with_fixed(substitute(e, holding));
  }

  const Model& model_;
  const ExpectedSystem& system_;
};

}  // namespace

std::vector<Expression> inertia_changes(const Model& model, const ExpectedSystem& system,
                                        std::string_view quantity) {
  constexpr std::array<std::string_view, 4> energies{"T", "L", "E", "h"};
  std::vector<Expression> changes = InertiaChanges(model, system).of_energy();
  if (std::ranges::find(energies, quantity) != energies.end()) return changes;
  const Symbols::Varying& q = system.symbols().coordinates;
  for (std::size_t i = 0; i < q.rate.size(); ++i) {
    if (quantity != "p_" + model.scene.coordinates[i].name) continue;
    for (Expression& change : changes) change = differentiate(change, q.rate[i]);
    return changes;
  }
  return {};
}

std::vector<Expression> inertia_changes(const Model& model, const ExpectedSystem& system,
                                        std::size_t coordinate) {
  const Symbols::Varying& q = system.symbols().coordinates;
  const Expression common =
      system.with_fixed(system.graph().adopt(model.equations.equations[coordinate].divided_by));
  std::vector<Expression> changes = InertiaChanges(model, system).of_energy();
  for (Expression& change : changes) {
    const Expression momentum = differentiate(change, q.rate[coordinate]);
    const Expression force = differentiate(change, q.value[coordinate]);
    change = (total_derivative(momentum, system.symbols().rates()) - force) / common;
  }
  return changes;
}

}  // namespace qdot
