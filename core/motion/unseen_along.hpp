#pragma once
// What sections of a motion may hide stays in doubt in those after them.

#include <map>
#include <span>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/motion/section_end.hpp"

namespace qdot {

class UnseenAlong {
 public:
  /// Takes what the next run hides in its rows, and up to its end.
  void add(Run& done);
  /// An impact may have been so much earlier or later, alike in all computations of this motion.
  void doubt_instant(const SectionEnd& impact, double late);

  /// Rows within `near` seconds of a kink may be on the wrong side of it.
  void doubt_side(const SectionEnd& kink, double near, std::span<const double> grid);

  /// Of all runs before the next one; empty where nothing is hidden.
  [[nodiscard]] const std::vector<double>& so_far() const { return unseen_; }
  /// As Run::unseen, of all runs; empty where nothing is hidden.
  [[nodiscard]] std::vector<double> take_rows();

 private:
  std::size_t count_{};  ///< of rows
  std::vector<double> unseen_, rows_;
  std::map<std::size_t, std::vector<double>> doubted_;  ///< how far a row may be
};

}  // namespace qdot
