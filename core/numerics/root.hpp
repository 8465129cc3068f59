#pragma once
// The place where a function changes sign, to round-off.

#include <functional>

namespace qdot {

/// Two neighbouring arguments: up to `before` the function still had its old sign, at `after` it is zero or
/// has the new one.
struct SignChange {
  double before{};
  double value_before{};
  double after{};
  double value_after{};
};

/// Narrows a bracket, whose values have opposite signs, until `before` and `after` are within two units in
/// their last place of each other or the function is exactly zero at `after`. NaN counts as the old sign.
/// Takes at most two evaluations more than bisection would, and some eight for a smooth function. Where the
/// place is much smaller than the ends of the bracket, that counts again for the bracket which these alone
/// give. Source: I. F. D. Oliveira, R. H. C. Takahashi, An enhancement of the bisection method average
/// performance preserving minmax optimality (the ITP method), ACM TOMS 47 (2021) 5, section 2.
[[nodiscard]] SignChange find_sign_change(const std::function<double(double)>& function, SignChange bracket);

/// How near to each other such places can be told apart at t: four units in the last place.
[[nodiscard]] double time_round_off(double t);

}  // namespace qdot
