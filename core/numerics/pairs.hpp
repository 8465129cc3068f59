#pragma once
// Two doubles side by side. Comparisons take one of both whole, as std::max(b, a) would: what is no number is
// never taken before what is one.

#include <cstdint>
#include <cstring>

namespace qdot {

using PairOfDoubles [[gnu::vector_size(16)]] = double;

[[nodiscard]] inline PairOfDoubles pair_at(const double* x) {
  PairOfDoubles v;
  std::memcpy(&v, x, sizeof v);
  return v;
}

inline void put_pair(double* x, PairOfDoubles v) { std::memcpy(x, &v, sizeof v); }

[[nodiscard]] inline PairOfDoubles magnitudes(PairOfDoubles x) {
  using Bits [[gnu::vector_size(16)]] = std::uint64_t;
  constexpr std::uint64_t without_sign = ~(std::uint64_t{1} << 63U);
  return reinterpret_cast<PairOfDoubles>(reinterpret_cast<Bits>(x) & Bits{without_sign, without_sign});
}

/// a where it is larger, b otherwise.
[[nodiscard]] inline PairOfDoubles larger_or(PairOfDoubles a, PairOfDoubles b) { return a > b ? a : b; }

}  // namespace qdot
