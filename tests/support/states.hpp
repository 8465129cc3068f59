#pragma once
// States of a model by name (parameters, t, inputs, q, q_dot, q_ddot) and what expressions are worth there.

#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/mechanics/model.hpp"
#include "tests/support/random.hpp"

namespace qdot::test {

/// Everything of order one: what must be positive in [0.2, 2), the rest in [-2, 2), accelerations included
/// though no motion has them: an equation must hold as an identity.
[[nodiscard]] Values random_state(const Model& model, Random& random);

/// The parameters among the values, in the model's order.
[[nodiscard]] std::vector<double> parameters_in(const Model& model, const Values& state);
/// q, then q_dot.
[[nodiscard]] std::vector<double> motion_in(const Model& model, const Values& state);

/// The value of e by walking its tree. Throws std::out_of_range for a symbol that the state does not know.
[[nodiscard]] double value_of(const Expression& e, const Values& state);

/// All outputs of a compiled function in a state of its model.
[[nodiscard]] std::vector<double> outputs_of(const CompiledFunction& function, const Model& model,
                                             const Values& state);

}  // namespace qdot::test
