#pragma once
// Equilibria and steady motions as states (q, q') of a scene, each component with a proven bound of its
// error.

#include <span>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/found_places.hpp"
#include "core/steady/stability.hpp"

namespace qdot {

struct SteadyState {
  std::vector<double> y;       ///< (q, q'): angles in (-pi, pi], ignored coordinates at their steady rates
  std::vector<double> errors;  ///< a proven bound for each component of y
  Box enclosure;               ///< of the coordinates x that are not ignored
  SteadyStability stability;
  double residual{};  ///< largest |g_i| at y [SI]
  /// Proven to be one simple zero. Otherwise a multiple zero,
  /// or several (or none) too close to be told apart.
  bool simple{};
  /// At a kink of the forces, where they take all values between those of its sides (core/steady/kinks.hpp).
  bool at_kink{};
  bool at_cone{};  ///< of that kind (core/steady/cones.hpp); at_kink, too
  Box sides;       ///< s_k of each kink: -1 or 1, or an enclosure where the place is at it
};

/// Numbers in the place of enclosures.
struct BoundedState {
  std::vector<double> y, errors;
};
/// At the place x of the kept coordinates, the ignored ones as in `y` and at the rates that their momenta,
/// among the constants, give them.
[[nodiscard]] BoundedState bounded_state(const SteadyProblem& problem, std::span<const Interval> constants,
                                         std::span<const double> y, const Box& x);

/// What a search has found, written as states.
class SteadyStates {
 public:
  /// Both must outlive it.
  SteadyStates(const SteadyProblem& problem, std::span<const double> y)
      : problem_(problem), y_(y), forces_(problem.forces->forces, problem.constants) {}

  /// Without its stability.
  [[nodiscard]] SteadyState at(const FoundPlace& found);
  /// All forces are zero there, exactly.
  [[nodiscard]] bool is_at_rest(const Box& x);

 private:
  template <class Size>
  double largest_force(const std::vector<double>& place, Size size);
  std::vector<double> least_residual(const Box& x, std::vector<double> best);

  const SteadyProblem& problem_;
  std::span<const double> y_;
  TapeEvaluator<Interval> forces_;
};

}  // namespace qdot
