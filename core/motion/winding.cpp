#include "core/motion/winding.hpp"

#include <algorithm>

#include "core/expr/full_turn.hpp"

namespace qdot {

std::vector<bool> winding_coordinates(const Model& model) {
  std::vector<Expression> all{model.lagrangian.lagrangian};
  all.insert(all.end(), model.lagrangian.generalized_forces.begin(),
             model.lagrangian.generalized_forces.end());
  for (const ConstraintEquation& constraint : model.lagrangian.constraints) all.push_back(constraint.rate);
  std::vector<bool> winding;
  for (const Expression& q : model.lagrangian.symbols.coordinates.value) {
    winding.push_back(std::ranges::all_of(all, [&](const Expression& e) { return has_full_turn(e, q); }));
  }
  return winding;
}

}  // namespace qdot
