#pragma once
// The kinks at which sections of a motion end, and from one side of which the motion passes to the other.

#include <vector>

#include "core/integrate/run.hpp"
#include "core/motion/running_motion.hpp"

namespace qdot {

class MetKinks {
 public:
  /// Keeps the reference.
  explicit MetKinks(RunningMotion& motion) : motion_(motion) {}

  /// Those that the section meets where it ends.
  [[nodiscard]] std::vector<bool> at_end(const Run& done) const;
  /// Notes kinks that may have been passed and passed back while their sign was hidden, up to the run's end.
  void doubt_hidden(const Run& done);
  /// A piece of the motion ends, by these kinks or by none.
  void record_piece(const std::vector<bool>& met);
  /// The next section begins behind them.
  void pass(const std::vector<bool>& met);
  /// A kink that is met exactly where the motion ends: whether it is passed there is not known.
  void doubt_last_row(const std::vector<bool>& met);

 private:
  [[nodiscard]] bool follow_too_fast() const;
  void begin_section(const std::vector<bool>& met);
  void doubt_side(SectionEnd& end);

  RunningMotion& motion_;
};

}  // namespace qdot
