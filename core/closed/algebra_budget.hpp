#pragma once
// How much algebra the search for one answer's formulas may take. It is not counted against the answer,
// which comes without formulas where this does not suffice.

#include <cstdint>

namespace qdot {

/// In the units of WorkScope (core/base/work.hpp).
inline constexpr std::uint64_t most_algebra = 1'000'000;

}  // namespace qdot
