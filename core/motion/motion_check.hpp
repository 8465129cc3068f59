#pragma once
// The second road to a motion, which tells the error of the first.
//
// Where the first is Taylor's method the second has another order, elsewhere another method, but where
// damping rules; it is a hundred times tighter, or ten times looser where it would be by the same method and
// cannot be tighter; and it goes from parameters and initial values moved in their last bits, so that a
// difference is not small by chance. Near round-off double-doubles tell more (extended_motion.hpp).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/motion/computed_motion.hpp"
#include "core/motion/events_in_doubt.hpp"

namespace qdot {

/// Its rows are those of event_rows. Numbers are moved up (1) or down (-1).
[[nodiscard]] SimulationRequest check_of(const ComputedMotion& motion, double direction);

/// The largest difference of each column.
[[nodiscard]] std::vector<double> largest_differences(const ComputedMotion& motion, const Simulation& check);

/// One check tells the error of truncation. Where round-off is as large, as the difference or what is
/// conserved shows, or the accelerations at some rows, a single difference may be small by chance; two checks
/// that start on either side cannot both be. Nor does it tell where most of the error stated would be what
/// the check may be off by itself.
[[nodiscard]] bool tells_truncation(const ComputedMotion& motion, const Simulation& check);

/// Why the check does not tell the error of the motion; nullptr where it does.
[[nodiscard]] const char* not_comparable(const ComputedMotion& motion, const Simulation& check);

/// Which impact a check meets more or less often than the motion, or which event, where it looks for them, in
/// a sentence. Checks look where the method's steps hide more than its error, or where that is
/// large: the motion may come so near to an event that it happens in one and not in the other.
[[nodiscard]] std::vector<EventDoubt> differing_events(const ComputedMotion& motion, const Simulation& check);

struct SharperMotion {
  std::optional<Simulation> simulation;  ///< rows of states alone, the last ones may be missing
  std::uint64_t evaluations{};           ///< in units of those in doubles
};

/// The motion from the numbers as they were typed, in so many digits that the difference is what rounding
/// did to it. None where it has kinks and impacts, where something may lie hidden, or where that is too much
/// work.
[[nodiscard]] SharperMotion in_more_digits(const ComputedMotion& motion, std::uint64_t evaluations_left);

}  // namespace qdot
