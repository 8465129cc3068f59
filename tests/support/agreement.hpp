#pragma once
// Comparisons whose measure is the size of what was added up.

#include <gtest/gtest.h>

#include "tests/support/hand_written.hpp"

namespace qdot::test {

/// Two ways to add up the same terms differ by some of their roundings, a few hundred times 2^-53 of the
/// terms' size at most. A wrong sign, factor or exponent shows in the first digits.
inline constexpr double round_off = 1e-12;

/// |value - expected| <= tolerance * size of the expected terms.
inline testing::AssertionResult agrees(double value, const Terms& expected, double tolerance = round_off) {
  const double difference = std::abs(value - expected.value);
  if (difference <= tolerance * expected.size) return testing::AssertionSuccess();
  return testing::AssertionFailure() << value << " for " << expected.value << ", off by " << difference
                                     << " in terms of size " << expected.size;
}

}  // namespace qdot::test
