#include "core/motion/values_at_kinks.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/column_errors.hpp"
#include "core/motion/kink_modes.hpp"
#include "core/numerics/root.hpp"

namespace qdot {

namespace {

StatedValues stated(const CompiledFunction& function, const std::vector<Column>& columns,
                    const Reals& parameters, double t, const Reals& y) {
  StatedValues stated{.values = values_at(function, columns, parameters, t, y), .errors = {}};
  stated.errors = value_errors(function, parameters, t, y, stated.values);
  return stated;
}

}  // namespace

StatedValues values_at_kinks(const Dynamics& dynamics, const std::vector<Column>& columns,
                             const Reals& parameters, double t, const Reals& y) {
  if (dynamics.kinks() == nullptr) return stated(*dynamics.columns(columns), columns, parameters, t, y);
  KinkModes modes(dynamics, parameters, 16 * time_round_off(std::max(1.0, std::abs(t))));
  modes.begin_at({parameters, t, y});
  const auto way = modes.way_on(t, y, std::vector<bool>(dynamics.kinks()->size()));
  if (!way) {
    throw Error(ErrorCode::invalid_state,
                "In this state the argument of an abs or a sign is zero, and the equations of motion do not "
                "tell how the motion goes on.");
  }
  const Staying staying = staying_on(way->sides);
  Reals with_sides = parameters;
  for (const int side : way->sides) with_sides.push_back(side);
  return stated(*dynamics.columns(columns, &staying), columns, with_sides, t, y);
}

}  // namespace qdot
