#pragma once
// Equilibria of one coordinate on either side of a small step of a parameter, joined by their order.
//
// Curves of zeros of one force g(x, p) meet nowhere but at critical points, so that in a step without one
// the k-th equilibrium goes on as the k-th, however near to each other two curves pass. A critical point in
// the step lies between the same curves on both sides of it:
//
//   saddle-node     two neighbours there on one side, none on the other
//   pitchfork       three on one side, one on the other, which goes on as the middle one
//   transcritical   two on both sides, which change places
//
// Of an angle the order is that round the circle. Source: Golubitsky, Schaeffer, Singularities and Groups in
// Bifurcation Theory I (1985), I.1 and II.1.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/steady/critical_value.hpp"

namespace qdot {

struct Continuation {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< before, after
  /// Which of those before vanish at a critical value of the step, or of those after appear there.
  std::vector<std::pair<std::size_t, const CriticalValue*>> ends, begins;
};

/// What a step of the parameter leads over.
struct OrderedStep {
  std::vector<double> before, after;           ///< the coordinate, in any order
  std::vector<int> signs_before, signs_after;  ///< stable 1, unstable -1, neither for certain 0
  std::vector<const CriticalValue*> critical;  ///< of the three kinds above
  std::size_t coordinate{};                    ///< which of the scene's
  bool turns{};                                ///< an angle modulo a turn
};

/// Whether the numbers of equilibria are what the critical values of the step say, all of them with new
/// equilibria on the same side; else the order tells nothing.
[[nodiscard]] bool is_counted(const OrderedStep& step);

/// None where the step is too long to tell which equilibria take part in what happens; needs is_counted.
[[nodiscard]] std::optional<Continuation> ordered_continuation(const OrderedStep& step);

}  // namespace qdot
