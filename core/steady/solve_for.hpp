#pragma once
// Which value of one number makes a position an equilibrium, or a steady motion: a parameter u, or the
// velocity u of an ignorable coordinate (the spin that holds a cone). The forces at the position,
//
//   g_i(x, u) = 0 for all i,
//
// are polynomials of u for most scenes, of degree 1 or 2: then u is their root in interval arithmetic. Else u
// is searched over its whole domain (core/numerics/root_isolation.hpp). All ignorable coordinates move with
// the velocities given, not with given momenta. Errors are proven bounds for the position taken as exact.
// With constraints g are the forces without their multipliers, and the constraints themselves
// (core/steady/position_statics.hpp).

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/steady/solvable_ranges.hpp"
#include "core/steady/stability.hpp"

namespace qdot {

struct SolvedValue {
  double value{};
  double error{};
  bool is_one{};  ///< proven; else there may be several within its error, or none
  SteadyStability stability;
};

struct Solution {
  std::vector<SolvedValue> values;  ///< non-negative ones first, then by size
  std::string reason;               ///< why there is none
  std::string unit;
  /// For one coordinate and a polynomial; ascending. No value where it is not known.
  std::optional<std::vector<SolvableRange>> ranges;
  std::shared_ptr<const SteadyPolynomial> polynomial;  ///< the forces, of the unknown
  std::vector<std::size_t> without_force;              ///< of these, that vanish there whatever it is
};

/// Names that can be solved for: the parameters, then the velocities of the ignorable coordinates.
[[nodiscard]] std::vector<std::string> solvable_names(const Dynamics& dynamics, const Reals& parameters);

/// The coordinates that the position must give, by number in the scene: those that forces depend on.
[[nodiscard]] std::vector<std::size_t> needed_coordinates(const Dynamics& dynamics, const Reals& parameters,
                                                          const std::string& unknown);

/// `y` = (q, q'): the position, and the velocities of the ignorable coordinates. `unknown` is one of
/// solvable_names; what `parameters` or `y` say of it does not matter.
[[nodiscard]] Solution solve_for(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                                 const std::string& unknown);

}  // namespace qdot
