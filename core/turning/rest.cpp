#include "core/turning/rest.hpp"

#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// The farthest that an equilibrium is looked for, relative to 1 + |x0|.
constexpr double neighbourhood = 1e-6;

/// The doubles on both sides of x.
Interval neighbours(double x) { return {std::nextafter(x, -infinity), std::nextafter(x, infinity)}; }

/// By Newton's step g/K.
std::optional<RestingPlace> smooth_equilibrium(EnergyBalance& energy) {
  const double x0 = energy.x0();
  const Interval g = energy.potential_rate(x0);
  const Interval k = energy.stiffness(x0);
  const std::string stability = k.lower > 0 ? "stable" : k.upper < 0 ? "unstable" : "neutral";
  if (!(g.magnitude() > 0)) return RestingPlace{0, stability};
  const double reach = neighbourhood * (1 + std::abs(x0));
  const Interval near = energy.stiffness({x0 - reach, x0 + reach});
  const double error = 2 * (g / near).magnitude();
  if (near.contains(0.0) || !(error < reach)) return std::nullopt;
  return RestingPlace{error, stability};
}

/// By the slopes on both sides: from below to above zero there is a minimum between them.
std::optional<RestingPlace> equilibrium_between(EnergyBalance& energy) {
  const double x0 = energy.x0();
  for (double reach = neighbours(x0).upper - x0; reach < neighbourhood * (1 + std::abs(x0)); reach *= 2) {
    const Interval left = energy.potential_rate(x0 - reach), right = energy.potential_rate(x0 + reach);
    if (left.upper < 0 && right.lower > 0) return RestingPlace{reach, "stable"};
    if (left.lower > 0 && right.upper < 0) return RestingPlace{reach, "unstable"};
  }
  return std::nullopt;
}

/// Whether the force at the double x0 has a sign, and x0 is not the double nearest to an equilibrium.
bool is_pushed(EnergyBalance& energy) {
  const double x0 = energy.x0();
  const Interval g = energy.potential_rate(x0);
  if (g.contains(0.0)) return false;
  const Interval near = neighbours(x0);
  const Interval k = energy.stiffness(near);
  return k.contains(0.0) || is_empty(intersection(Interval(x0) - g / k, near));
}

}  // namespace

std::optional<RestingPlace> resting_place(EnergyBalance& energy) {
  const auto smooth = smooth_equilibrium(energy);
  return smooth ? smooth : equilibrium_between(energy);
}

bool departs_from_rest(EnergyBalance& energy) {
  if (is_pushed(energy)) return true;
  if (energy.potential_rate_at_start().contains(0.0)) return false;
  const auto place = resting_place(energy);
  return !place || place->stability != "stable";
}

}  // namespace qdot
