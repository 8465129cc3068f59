#pragma once
// Motions that begin, or come, where a speed in their equations is zero: drag c |v| v of a ball that is
// dropped.
//
// There |v| = sqrt(S), S = q'.H(q) q' >= 0, has no Taylor series in the state, but the equations have values
// and, as |v| is Lipschitz, one solution: from rest v = a t + ..., so |v| = |a| t + ... is smooth after the
// start. A very short first step leaves the place; all others are Taylor's. What the short step may be off by
// follows from the accelerations over a box around it: by no more than h w in q', h^2 w in q, w being the
// width of q'' there. Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis, 10.1 (enclosure by
// Picard's operator).

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/motion/simulation_request.hpp"

namespace qdot {

class StartFromRest {
 public:
  /// Keeps the references.
  StartFromRest(const Dynamics& dynamics, const SimulationRequest& request);
  ~StartFromRest();

  /// How long the first step from (t, y) is; none where no speed is zero there, or where a zero speed
  /// divides.
  [[nodiscard]] std::optional<double> length(double t, std::span<const double> y,
                                             const RightHandSide& system) const;
  /// What that step may be off by, of each component; none where that is not known.
  [[nodiscard]] std::optional<std::vector<double>> bound(double t, std::span<const double> y,
                                                         double length) const;

 private:
  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  std::size_t speeds_{};
  std::unique_ptr<const CompiledFunction> squares_;    ///< of each speed S, then the n x n numbers 2 H
  std::unique_ptr<const CompiledFunction> equations_;  ///< M by rows, then f; null with kinks or constraints
};

}  // namespace qdot
