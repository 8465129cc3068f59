#pragma once
// One of a scene's impacts as what it does to the velocities of a state.

#include <memory>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/motion/computed_motion.hpp"
#include "core/motion/impact_map.hpp"
#include "core/motion/section_record.hpp"

namespace qdot {

/// One for each of the motion's impacts, in their order.
[[nodiscard]] std::vector<Watch> watches_of_impacts(const ComputedMotion& motion);

class Bounce {
 public:
  /// Keeps a reference to the watch, which is that of the impact.
  Bounce(const ComputedMotion& motion, const ParsedImpact& impact, const Watch& watch);

  [[nodiscard]] const Watch& watch() const { return watch_; }

  /// What it would change in the velocities at (t, y).
  [[nodiscard]] std::vector<double> kick(double t, const std::vector<double>& y);

  /// Whether another one at (t, y) would change nothing of what it has changed before, but for rounding.
  [[nodiscard]] bool leaves_nothing(double t, const std::vector<double>& y, const SectionRecord& before);

  /// What it changes, if the motion goes on towards it: it turns what it takes back, and so it did before.
  [[nodiscard]] std::vector<double> change(double t, const std::vector<double>& y,
                                           const SectionRecord& before);

  /// The way k on which the contact moves the coordinates, such that dg = sum_i dg/dq_i k_i = 1; all 0 where
  /// there is none.
  [[nodiscard]] std::vector<double> way(double t, const std::vector<double>& y);

 private:
  std::vector<double> map(double t, std::vector<double> y);

  const Watch& watch_;
  ImpactMap map_;
  std::shared_ptr<const CompiledFunction> components_;
  Workspace workspace_;
};

}  // namespace qdot
