#pragma once
// Decimals as they are written: "12.5e-3" is 125 * 10^-4.

#include <optional>
#include <string>
#include <string_view>

namespace qdot {

/// A decimal taken apart: digits * 10^exponent.
struct Decimal {
  std::string digits;  ///< without leading zeros; none for 0
  int exponent{0};
};

/// What `text` writes; none for anything else, a sign included, and for exponents beyond 100,000.
[[nodiscard]] std::optional<Decimal> take_apart(std::string_view text);

}  // namespace qdot
