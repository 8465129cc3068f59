#pragma once
// The slip that explains a wrong number, where exactly one of the usual ones does.

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace qdot {

enum class NumberSlip {
  sign,
  degrees,  ///< degrees where radians are asked for
  radians,  ///< radians where degrees are asked for
  period,   ///< 2 pi/omega for omega, or 1/f for f
  rate,     ///< omega for a period, or for f
  turns,    ///< f for omega, or for a period
  factor,   ///< twice or half of it
  power     ///< its square or root
};

/// "sign", "degrees", ...
[[nodiscard]] const char* name_of(NumberSlip slip);

/// What the slips give in place of an expected number, in an order of its own for each unit; none for zero.
[[nodiscard]] std::vector<std::pair<NumberSlip, double>> slips_of(double expected, std::string_view unit);

/// `unit` is that of the expected number: "rad", "deg", "rad/s", "Hz" and "s" have slips of their own. What
/// was submitted has to agree to 1e-3 with what one slip gives, and with no other.
[[nodiscard]] std::optional<NumberSlip> find_number_slip(double submitted, double expected,
                                                         std::string_view unit);

}  // namespace qdot
