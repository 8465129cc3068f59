#pragma once
// The squared speed of an energy integral where its parameters have other numbers.

#include "core/closed/barriers.hpp"
#include "core/closed/elementary_period.hpp"
#include "core/closed/rough_period.hpp"
#include "core/closed/tries.hpp"
#include "core/compile/compiled_function.hpp"

namespace qdot {

/// Whether the inertia is positive where x and the parameters have these numbers: nothing is answered
/// elsewhere.
[[nodiscard]] bool is_heavy(const QuadratureProblem& problem, double x, FarPlace far);

/// v^2 with numbers in place of all but x; compiled once for places of the same symbols.
class SpeedAt {
 public:
  SpeedAt(const QuadratureProblem& problem, const FarPlace& like);
  /// Outlived by this.
  [[nodiscard]] SquaredSpeed at(const FarPlace& place) const;

 private:
  CompiledFunction function_;
  std::optional<Barriers> barriers_;
  bool may_have_poles_{};
};

}  // namespace qdot
