#pragma once
// How many terms a series of what a step adds to e needs (separation.hpp): two small ones in a row show that
// the rest is.

#include <algorithm>
#include <cmath>

namespace qdot {

inline constexpr unsigned least_order = 8;
inline constexpr double negligible = 0.03;  ///< of the largest term

/// For the term(k) of one component, k <= order, where others need `enough` already; more than the order
/// where it has no such end.
template <class Term>
[[nodiscard]] unsigned order_that_does(unsigned order, unsigned enough, double largest, const Term& term) {
  unsigned last = order;
  while (last + 2 > enough && std::abs(term(last)) <= negligible * largest) --last;
  return std::max(enough, last + 2);
}

}  // namespace qdot
