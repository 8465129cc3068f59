#include "core/grading/number_slip.hpp"

#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr double closeness = 1e-3;

using Slips = std::vector<std::pair<NumberSlip, double>>;

/// What the slips give that belong to a unit.
Slips slips_of_unit(double x, std::string_view unit) {
  using enum NumberSlip;
  if (unit == "rad") return {{degrees, x * 180 / pi}};
  if (unit == "deg") return {{radians, x * pi / 180}};
  if (unit == "rad/s") return {{period, 2 * pi / x}, {turns, x / (2 * pi)}, {degrees, x * 180 / pi}};
  if (unit == "Hz") return {{period, 1 / x}, {rate, 2 * pi * x}};
  if (unit == "s") return {{rate, 2 * pi / x}, {turns, 1 / x}};
  return {};
}

}  // namespace

const char* name_of(NumberSlip slip) {
  constexpr const char* names[]{"sign", "degrees", "radians", "period", "rate", "turns", "factor", "power"};
  return names[static_cast<std::size_t>(slip)];
}

std::vector<std::pair<NumberSlip, double>> slips_of(double expected, std::string_view unit) {
  using enum NumberSlip;
  if (expected == 0 || !std::isfinite(expected)) return {};
  Slips slips = slips_of_unit(expected, unit);
  for (const auto& plain :
       Slips{{sign, -expected}, {factor, 2 * expected}, {factor, expected / 2}, {power, expected * expected}})
    slips.push_back(plain);
  if (expected > 0) slips.emplace_back(power, std::sqrt(expected));
  return slips;
}

std::optional<NumberSlip> find_number_slip(double submitted, double expected, std::string_view unit) {
  std::optional<NumberSlip> found;
  for (const auto& [slip, value] : slips_of(expected, unit)) {
    if (!(std::abs(submitted - value) <= closeness * std::abs(value))) continue;
    if (found) return std::nullopt;
    found = slip;
  }
  return found;
}

}  // namespace qdot
