#pragma once
// Impacts that follow each other faster and faster: a ball that comes to rest bounces infinitely often in a
// finite time (Zeno). The time from one impact to the next, or where several take turns from one round of
// them to the next, shrinks by a factor q each; all that are left take d q/(1 - q) together.

#include <optional>
#include <span>

#include "core/motion/section_record.hpp"

namespace qdot {

/// The reason that a motion ends with then.
inline constexpr const char* impacts_accumulate = "impacts_accumulate";

/// How long all further impacts take together, once that is of no account beside the span of the motion.
[[nodiscard]] std::optional<double> rest_of_impacts(std::span<const SectionRecord> sections, double span);

/// An estimate of what the time at which they end may be off, the errors of the impacts apart. A flight of
/// duration d is d^2 g/8 high: those are not seen that are lower than the rounding of the longest one's
/// height.
[[nodiscard]] double doubt_of_accumulation(std::span<const SectionRecord> sections, double span);

}  // namespace qdot
