#pragma once
// Of forces along one coordinate x, the first place downhill of a start where they vanish: by intervals that
// follow each other, on each of which g keeps its sign, or rises through one zero.

#include <optional>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/kinks.hpp"

namespace qdot {

/// g and its slope along the kept coordinate `unknown`, the others being in `place`.
class ForceAlongLine {
 public:
  /// `constants` are the reduction's. `statics` and `smooth` must outlive it.
  ForceAlongLine(const Statics& statics, const SmoothForces& smooth, std::span<const Interval> constants,
                 std::vector<Interval> place, std::size_t unknown);

  [[nodiscard]] Interval force(const Interval& x);
  /// No value where g may jump.
  [[nodiscard]] std::optional<Interval> slope(const Interval& x);

 private:
  std::size_t unknown_, unknowns_, kinks_;
  TapeEvaluator<Interval> forces_, stiffness_, arguments_;
  std::vector<Interval> x_, g_, k_, u_;  ///< x_ with the sides of the kinks
};

/// An interval with the first zero of g from `start` on in the direction of -g(start), at which g rises, and
/// with no other; none lies between. No value where that is not proven. `size` is x's.
[[nodiscard]] std::optional<Interval> next_balance(ForceAlongLine& line, double start, double size);

}  // namespace qdot
