#pragma once
// Jumps of a Lagrangian. The derivative of sign(u) is written 0, and that of atan(u) + atan(1/u) is 0 but
// where u vanishes: a derivative that leaves a jump out proves no symmetry, and a jump of a potential or of a
// momentum is an impulse, which no equation of motion here has.

#include <span>
#include <string>
#include <vector>

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// Each sign of what varies, and each arc tangent of the time, or of one other variable, that may have poles,
/// as a function that is smooth and in no relation to others: what keeps e so keeps it with its jumps.
class SmoothedJumps {
 public:
  SmoothedJumps(const Expression& e, const Symbols& symbols);

  [[nodiscard]] const Expression& smooth() const { return smooth_; }
  /// What was derived from smooth(), of e. No derivatives of the functions themselves.
  [[nodiscard]] Expression with_jumps(const Expression& e) const;

 private:
  Expression smooth_;
  std::vector<Replacement> back_;
};

/// Why no motion is computed: a sign of coordinates or rates across which L is not continuous, or one of the
/// time across which a momentum is not. A sentence, or empty.
[[nodiscard]] std::string impulse_of_jumps(const Scene& scene, const Lagrangian& lagrangian);

}  // namespace qdot
