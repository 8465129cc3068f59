#pragma once
// The slips in formulas and equations that have a name, which the student is given.

namespace qdot {

enum class Slip {
  sign,              ///< of one term
  factor,            ///< a number in front of one term
  dropped_term,      ///< one term is missing
  whole_sign,        ///< of the formula
  whole_factor,      ///< a number in front of the formula
  exponent,          ///< of one symbol in one term
  sine_and_cosine,   ///< one stands for the other in one term, or everywhere
  argument,          ///< of a function in one term
  small_angles,      ///< sin u = u, cos u = 1
  gravity,           ///< points the other way
  moment_of_inertia  ///< of a body, about another point
};

/// "sign", "factor", "dropped_term", ...
[[nodiscard]] const char* name_of(Slip slip);

}  // namespace qdot
