#pragma once
// What lies between two impacts, or between two kinks.

#include <cstddef>
#include <vector>

namespace qdot {

/// A section of the motion that an impact ended.
struct SectionRecord {
  double t{};                         ///< of that impact
  double duration{};                  ///< since the impact before, or since t_start
  std::vector<double> before, after;  ///< the state just before the impact and just after it
  std::vector<std::size_t> impacts;   ///< those of that instant, by their numbers in the model
};

/// A piece of a motion with kinks, smooth, on one side of each of them or staying on it.
struct PieceRecord {
  double t{};                         ///< of its end
  double duration{};                  ///< since it began
  std::vector<int> sides;             ///< KinkModes::Way::sides
  std::vector<std::size_t> ended_by;  ///< kinks; none where the motion ended
};

}  // namespace qdot
