#pragma once

#include <cstdint>

namespace qdot {

/// What the search for one answer's formulas may cost (core/base/work.hpp). It is not counted against the
/// answer itself, which comes without formulas where it does not suffice.
inline constexpr std::uint64_t most_algebra = 1'000'000;

}  // namespace qdot
