#pragma once
// A motion of one coordinate x, made ready for its energy integral h = 1/2 A(x) x'^2 + U(x): what is left of
// the scene after Routh's reduction, and its constants.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

struct EnergyProblem {
  std::shared_ptr<const Statics> original;  ///< of the scene
  /// The same without the momenta that are exactly 0,
  /// for nothing is divided by what they were multiplied with.
  std::shared_ptr<const Statics> statics;
  std::vector<Ball> constants;  ///< the parameters, then the momenta of the ignored coordinates
  std::size_t coordinate{};     ///< x, by number in the scene
};

/// Empty where the energy integral answers for `coordinate`;
/// else why it does not, in words that go on after "because".
[[nodiscard]] std::string why_not_by_energy(const Dynamics& dynamics, const Reals& parameters,
                                            std::size_t coordinate);

/// For the one coordinate that is left, with the momenta of the state y. Throws Error(not_applicable) where
/// the energy integral does not answer.
[[nodiscard]] EnergyProblem energy_problem(const Dynamics& dynamics, const Reals& parameters, const Reals& y);

}  // namespace qdot
