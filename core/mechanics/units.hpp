#pragma once
// Units as texts: "N*s/m", "deg", "m/s²".

#include <optional>
#include <string_view>

#include "core/mechanics/dimension.hpp"

namespace qdot {

/// Reads "N*s/m", "N s/m", "kg*m^2", "rev/s", "1/s", "/s", "N/(m/s)", "deg", "m^(1/2)", "1". Products,
/// quotients, powers with small exponents (^ or **), parentheses; nothing else. At most 80 bytes; no value
/// for anything it cannot read. Names: kg g mg, km m cm mm um, s ms us min h, rad deg rev, Hz rpm, N kN mN, J
/// kJ mJ, W kW, Pa kPa MPa, A mA, C, V, T, ohm; of other systems in ft yd mi lb lbf dyn erg cal gon.
[[nodiscard]] std::optional<Unit> parse_unit(std::string_view text);

}  // namespace qdot
