#pragma once
// Integration of y' = f(t, y) in double-doubles over a grid, and how far its rounding, its truncation and
// what its steps may hide have been carried by the motion (separation.hpp).

#include <span>
#include <vector>

#include "core/integrate/extended_stepper.hpp"

namespace qdot {

struct ExtendedRun {
  std::size_t rows{};                  ///< instants of the grid that were reached
  std::vector<DoubleDouble> states{};  ///< rows x dimension, row-major
  std::vector<double> passed{};        ///< largest |y| at steps up to each row, rows x dimension
  /// What the rounding of coefficients in doubles has come to at each row, where that is wanted
  /// (separation.hpp; rows x dimension).
  std::vector<double> apart{};
  Ending ending{Ending::reached_end};
  DoubleDouble t;  ///< where the run ended: t_end, the last good step, or where a margin is used up (`event`)
  std::vector<DoubleDouble> y{};       ///< the state there
  std::vector<double> apart_at_end{};  ///< as in `apart`, with signs
  std::uint64_t steps{}, evaluations{};
  bool bounded{};  ///< nothing lies hidden between the places that were looked at
};

/// The states at the instants of the grid, increasing in [t_start, t_end]; all of them in seconds.
[[nodiscard]] ExtendedRun integrate(const ExtendedSystem& system, const ExtendedRunRequest& request,
                                    std::span<const DoubleDouble> grid);

/// The order that reaches a tolerance with the least work, about -ln(rtol)/2 (Jorba, Zou, section 3.1).
[[nodiscard]] unsigned extended_order(double rtol, unsigned highest);

}  // namespace qdot
