#include "core/mechanics/friction.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

enum class Without { workless, all };

std::vector<Expression> forces_without(const Lagrangian& lagrangian, Without kind) {
  std::vector<Expression> forces = lagrangian.generalized_forces;
  if (lagrangian.constraints.empty()) return forces;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    for (std::size_t j = 0; j < lagrangian.constraints.size(); ++j) {
      const ConstraintEquation& constraint = lagrangian.constraints[j];
      if (kind == Without::all || is_workless(constraint, lagrangian.symbols))
        forces[i] = forces[i] - lagrangian.symbols.multipliers[j] * constraint.slope[i];
    }
    forces[i] = simplify(forces[i]);
  }
  return forces;
}

}  // namespace

std::vector<Expression> working_forces(const Lagrangian& lagrangian) {
  return forces_without(lagrangian, Without::workless);
}

bool has_forces_of_multipliers(const Lagrangian& lagrangian) {
  return std::ranges::any_of(forces_without(lagrangian, Without::all), [&](const Expression& force) {
    return depends_on(force, lagrangian.symbols.multipliers);
  });
}

}  // namespace qdot
