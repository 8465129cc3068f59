#include "core/motion/values_at_kinks.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/kink_modes.hpp"
#include "core/numerics/root.hpp"

namespace qdot {

std::vector<double> values_at_kinks(const Dynamics& dynamics, const std::vector<Column>& columns,
                                    std::span<const double> parameters, double t, std::span<const double> y) {
  if (dynamics.kinks() == nullptr) return values_at(dynamics, columns, parameters, t, y);
  KinkModes modes(dynamics, parameters, 16 * time_round_off(std::max(1.0, std::abs(t))));
  const auto way = modes.way_on(t, y, std::vector<bool>(dynamics.kinks()->size()));
  if (!way) {
    throw Error(ErrorCode::invalid_state,
                "In this state the argument of an abs or a sign is zero, and the equations of motion do not "
                "tell how the motion goes on.");
  }
  const Staying staying = staying_on(way->sides);
  return values_at(*dynamics.columns(columns, &staying), columns, modes.parameters(way->sides), t, y);
}

}  // namespace qdot
