#pragma once
// Numbers with more digits than doubles have, as text.

#include <string>

#include "core/numerics/double_double.hpp"

namespace qdot::api {

/// Significant digits of numbers in extended precision.
inline constexpr int most_digits = 31;

/// The finite number to so many significant digits, the nearest of them (ties to the even one), without
/// trailing zeros: "0.5", "-1.234e-7". JSON reads it as a number.
[[nodiscard]] std::string extended_text(const DoubleDouble& value, int digits = most_digits);

}  // namespace qdot::api
