#pragma once
// The kinds of critical values: which of the zeros of core/steady/bifurcation_systems.hpp are folds,
// crossings and pitchforks, and which remain unresolved, each of these with its reason.

#include <optional>
#include <span>
#include <vector>

#include "core/steady/critical_value.hpp"
#include "core/steady/critical_zeros.hpp"
#include "core/steady/normal_form.hpp"

namespace qdot {

struct KnownZero {
  CriticalZero zero;
  BifurcationKind kind{};
  const char* reason{""};         ///< why it is unresolved (core/steady/critical_sentences.hpp)
  std::optional<Interval> omega;  ///< of oscillations that begin to grow, where it is known
};

/// Of one unknown: `zeros` of N = N_x = 0, and what happens on the axes of symmetry. What lies at one of the
/// values `degenerate` is left out.
[[nodiscard]] std::vector<KnownZero> kinds_by_normal_form(const SteadyProblem& problem,
                                                          const BifurcationSystems& systems,
                                                          std::span<const CriticalZero> zeros,
                                                          SymmetryAxes& axes,
                                                          std::span<const double> degenerate);

/// Of several unknowns, whose forces are families of factors. A fold alone is a saddle-node: its system is
/// regular only where it is one. Two families that cross, and neither folds, are a transcritical point; one
/// that folds on the mirror of a symmetry (core/steady/mirrors.hpp), a pitchfork.
[[nodiscard]] std::vector<KnownZero> kinds_by_families(const SteadyProblem& problem,
                                                       const BifurcationSystems& systems,
                                                       const CriticalZeros& found);

}  // namespace qdot
