#include "core/mechanics/reaction_sizes.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/equations_of_motion.hpp"
#include "core/mechanics/reaction_terms.hpp"

namespace qdot {
namespace {

/// The components of all forces and torques.
std::vector<Expression*> components_of(ParsedScene& scene) {
  std::vector<Expression*> all;
  for (ParsedForce& force : scene.forces)
    for (Expression& component : force.vector) all.push_back(&component);
  for (ParsedTorque& torque : scene.torques)
    for (Expression& component : torque.vector) all.push_back(&component);
  return all;
}

std::vector<Diagnostic> refused(const std::string& why) {
  return {{"/forces", "not_linear",
           why + " Write friction as -mu*N*sign(x_dot), with a condition under valid_while that ends the "
                 "motion where N changes its sign."}};
}

/// Of q'' and the multipliers, as functions of the state and of the sides.
std::vector<Expression> solved_motion(const ParsedScene& scene) {
  try {
    const Lagrangian lagrangian = derive_lagrangian(scene);
    return solved(augmented(derive_equations(lagrangian), lagrangian));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return {};
  }
}

}  // namespace

std::vector<Diagnostic> write_sizes_of_reactions(const Scene& scene, ParsedScene& parsed) {
  const std::vector<Expression>& multipliers = parsed.symbols.multipliers;
  if (multipliers.empty()) return {};
  const std::vector<Expression*> components = components_of(parsed);
  std::vector<Expression> written;
  for (const Expression* component : components) written.push_back(*component);
  const Unfolded all = unfolded(written, multipliers);
  if (all.arguments.empty()) return {};
  for (std::size_t i = 0; i < components.size(); ++i) *components[i] = all.smooth[i];
  const std::vector<Expression> solution = solved_motion(parsed);
  if (solution.empty())
    return refused("The reaction whose abs() stands in a force is too long to be written.");
  std::vector<Expression> sizes;
  for (const Expression& lambda : all.arguments) {
    const auto j = static_cast<std::size_t>(std::ranges::find(multipliers, lambda) - multipliers.begin());
    const Expression value = simplify(solution[parsed.symbols.coordinates.value.size() + j]);
    if (depends_on(value, all.sides))
      return refused("The friction of '" + multiplier_name(scene.constraints[j]) +
                     "' changes that reaction itself, so that its abs() is no function of the state.");
    sizes.push_back(parsed.graph->call(Function::abs, value));
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    const ReactionTerms found = reaction_terms(all.smooth[i], all, multipliers);
    *components[i] = found.without;
    for (std::size_t k = 0; k < sizes.size(); ++k) *components[i] = *components[i] + found.of[k] * sizes[k];
  }
  return {};
}

}  // namespace qdot
