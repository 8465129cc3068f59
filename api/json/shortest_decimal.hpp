#pragma once
// The shortest decimal that is read back as a double, and of those that are as short the nearest to it.
//
// A double is c 2^q. Decimals d 10^k between the middles to its two neighbours are read back as it, with k
// chosen so that at least one and at most ten of them lie there: then one of the neighbours of c 2^q 10^(-k)
// is the shortest, or that over ten. To tell which, 2^q 10^(-k) has to be known to 126 bits; it is kept with
// 128, rounded up. Source: Raffaello Giulietti, The Schubfach way to render doubles (2021), sections 9
// and 10.

#include <cstdint>

namespace qdot::api {

/// digits 10^exponent; the last digit is not 0.
struct Decimal {
  std::uint64_t digits{};
  int exponent{};
};

/// Of a finite number above zero.
[[nodiscard]] Decimal shortest_decimal(double value);

}  // namespace qdot::api
