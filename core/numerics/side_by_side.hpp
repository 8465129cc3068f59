#pragma once
// What computes with one double and with two side by side alike. Of two each has the bits that it has alone.

#include <cmath>

#include "core/numerics/pairs.hpp"

namespace qdot {

template <class Number>
inline constexpr unsigned count_of = sizeof(Number) / sizeof(double);

[[nodiscard]] inline double one_of(double x, unsigned) { return x; }
[[nodiscard]] inline double one_of(const PairOfDoubles& x, unsigned i) { return x[i]; }

[[nodiscard]] inline double square_root(double x) { return std::sqrt(x); }
[[nodiscard]] inline PairOfDoubles square_root(const PairOfDoubles& x) {
  return PairOfDoubles{std::sqrt(x[0]), std::sqrt(x[1])};
}

/// f(0), or f(0) and f(1).
template <class Number, class F>
[[nodiscard]] Number of_each(const F& f) {
  if constexpr (count_of<Number> == 1)
    return f(0);
  else
    return Number{f(0), f(1)};
}

}  // namespace qdot
