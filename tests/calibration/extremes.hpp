#pragma once
// Motions at the extremes, each to be within its stated error or refused with a reason.

#include <string>
#include <vector>

#include "tests/calibration/outcome.hpp"

namespace qdot::test {

struct Extreme {
  std::string group, name;
  Asked asked;
  std::uint64_t reference_steps{};  ///< 0: the motion needs a longer reference than there is time for
};

[[nodiscard]] std::vector<Extreme> extremes();

/// What became of it, in a word; "NOT HELD" is what must not be.
[[nodiscard]] std::string fate(const Outcome& outcome);

}  // namespace qdot::test
