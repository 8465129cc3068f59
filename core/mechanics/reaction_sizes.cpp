#include "core/mechanics/reaction_sizes.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/unfold.hpp"
#include "core/mechanics/equations_of_motion.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {
namespace {

/// c = a + sum of b_k s_k lambda_k.
struct ReactionSizes {
  Expression without;          ///< a
  std::vector<Expression> of;  ///< b_k
  bool is_linear{};            ///< in the multipliers, too
};

ReactionSizes sizes_in(const Expression& smooth, const Unfolded& unfolded,
                       const std::vector<Expression>& multipliers) {
  ReactionSizes result{smooth, {}, true};
  for (std::size_t k = 0; k < unfolded.sides.size(); ++k) {
    const Expression& s = unfolded.sides[k];
    const Expression& lambda = unfolded.arguments[k];
    const Expression along = differentiate(smooth, s);
    result.of.push_back(differentiate(along, lambda));
    const bool is_size = std::ranges::find(multipliers, lambda) != multipliers.end() &&
                         simplify(along - lambda * result.of[k]).is_zero() &&
                         !depends_on(result.of[k], multipliers) && !depends_on(result.of[k], unfolded.sides);
    result.is_linear = result.is_linear && is_size;
    const std::vector<Replacement> none{{s, s.graph().number(0)}};
    result.without = substitute(result.without, none);
  }
  for (const Expression& lambda : multipliers)
    result.is_linear = result.is_linear && !depends_on(differentiate(result.without, lambda), multipliers);
  return result;
}

/// The components of all forces and torques.
std::vector<Expression*> components_of(ParsedScene& scene) {
  std::vector<Expression*> all;
  for (ParsedForce& force : scene.forces)
    for (Expression& component : force.vector) all.push_back(&component);
  for (ParsedTorque& torque : scene.torques)
    for (Expression& component : torque.vector) all.push_back(&component);
  return all;
}

[[noreturn]] void refuse(const std::string& why) {
  throw SceneError(
      {{"/forces", "not_linear",
        why + " Write friction as -mu*N*sign(x_dot), with a condition under valid_while that ends the "
              "motion where N changes its sign."}});
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

bool is_linear_in_reactions(const Expression& component, const std::vector<Expression>& multipliers) {
  if (!depends_on(component, multipliers)) return true;
  const Unfolded all = unfolded({&component, 1}, multipliers);
  return sizes_in(all.smooth[0], all, multipliers).is_linear;
}

void write_sizes_of_reactions(const Scene& scene, ParsedScene& parsed) {
  const std::vector<Expression>& multipliers = parsed.symbols.multipliers;
  if (multipliers.empty()) return;
  const std::vector<Expression*> components = components_of(parsed);
  std::vector<Expression> written;
  for (const Expression* component : components) written.push_back(*component);
  const Unfolded all = unfolded(written, multipliers);
  if (all.arguments.empty()) return;
  for (std::size_t i = 0; i < components.size(); ++i) *components[i] = all.smooth[i];
  const std::vector<Expression> solution = solved_motion(parsed);
  if (solution.empty()) refuse("The reaction whose abs() stands in a force is too long to be written.");
  std::vector<Expression> sizes;
  for (const Expression& lambda : all.arguments) {
    const auto j = static_cast<std::size_t>(std::ranges::find(multipliers, lambda) - multipliers.begin());
    const Expression value = simplify(solution[parsed.symbols.coordinates.value.size() + j]);
    if (depends_on(value, all.sides))
      refuse("The friction of '" + multiplier_name(scene.constraints[j]) +
             "' changes that reaction itself, so that "
             "its abs() is no function of the state.");
    sizes.push_back(parsed.graph->call(Function::abs, value));
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    const ReactionSizes found = sizes_in(all.smooth[i], all, multipliers);
    *components[i] = found.without;
    for (std::size_t k = 0; k < sizes.size(); ++k) *components[i] = *components[i] + found.of[k] * sizes[k];
  }
}

}  // namespace qdot
