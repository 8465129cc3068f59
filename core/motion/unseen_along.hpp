#pragma once
// What sections of a motion may hide stays in doubt in those after them.

#include <vector>

#include "core/motion/section_end.hpp"
#include "core/motion/simulation.hpp"

namespace qdot {

class UnseenAlong {
 public:
  /// The rows of a run, which the simulation does not count yet.
  void add(const Run& done, Simulation& simulation);
  /// An impact may have been a round-off of t earlier or later, alike in all computations of this motion.
  void doubt_instant(const SectionEnd& impact);

 private:
  std::vector<double> unseen_;  ///< of each component; empty where there is nothing
};

}  // namespace qdot
