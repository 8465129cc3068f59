#pragma once
// The search for an equilibrium as expressions of the parameters (exact_place.hpp): each force that only one
// unknown stands in is solved for it, one after the other. What is found is proven by putting it into the
// forces, which have to vanish identically.

#include <optional>

#include "core/closed/exact_place.hpp"

namespace qdot {

/// No value where none of the forms solves g = 0. The problem has to outlive the place.
[[nodiscard]] std::optional<ExactPlace> exact_place(const PlaceProblem& problem);

/// u where e = 0, e an expression of u and of what is known: the one that is near.
[[nodiscard]] std::optional<Expression> solved_for(const Expression& e, const Expression& u,
                                                   const Interval& near, const SignOf& sign);

/// With the known angles and zeros alone, whether forces vanish there or not.
[[nodiscard]] ExactPlace special_place(const PlaceProblem& problem);

}  // namespace qdot
