#pragma once
// What sections of a motion may hide stays in doubt in those after them.

#include <utility>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/motion/section_end.hpp"

namespace qdot {

class UnseenAlong {
 public:
  /// The next run's rows, and what it hides up to its end.
  void add(const Run& done);
  /// An impact may have been a round-off of t earlier or later, alike in all computations of this motion.
  void doubt_instant(const SectionEnd& impact);

  /// As Run::unseen, of all runs; empty where nothing is hidden.
  [[nodiscard]] std::vector<double> take_rows() { return std::move(rows_); }

 private:
  std::size_t count_{};  ///< of rows
  std::vector<double> unseen_, rows_;
};

}  // namespace qdot
