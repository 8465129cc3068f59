#pragma once
// Numbers as sentences and messages have them: with a few digits, and no more than a reader needs.

#include <string>

namespace qdot {

/// x with so many significant digits, "0.3333" or "1e-06", as printf("%.4g") writes it in any locale.
[[nodiscard]] std::string short_number(double x, int digits = 4);

}  // namespace qdot
