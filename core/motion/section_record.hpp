#pragma once
// What lies between two impacts.

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

}  // namespace qdot
