#pragma once
// Initial states that obey the constraints, in all the digits that were typed.

#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/dynamics/dynamics.hpp"

namespace qdot {

/// An initial state that violates constraints, and the nearest that does not.
class InconsistentState : public Error {
 public:
  using Nearest = std::vector<std::pair<std::string, double>>;
  InconsistentState(const std::string& message, Nearest nearest)
      : Error(ErrorCode::invalid_state, message), nearest_(std::move(nearest)) {}
  /// (q, q') by name; empty where none was found.
  [[nodiscard]] const Nearest& nearest() const { return nearest_; }

 private:
  Nearest nearest_;
};

/// Throws Error(invalid_state): in this state they depend on each other, or one alone has no slope.
[[noreturn]] void refuse_dependent_constraints(const Scene& scene);

/// (q, q') as it is without constraints. With them, a state whose residuals are within 1e-12 of their terms,
/// as decimals of 13 digits give them, is moved onto the surface to twice the digits of a double; any other
/// is refused. Of the nearest state, what is `given` (2n, q then q') stays where that is possible. Throws
/// InconsistentState, and Error(invalid_state) where the constraints have no value or determine no forces.
[[nodiscard]] Reals consistent_state(const Dynamics& dynamics, const Reals& parameters, double t,
                                     const Reals& y, const std::vector<bool>& given);

/// The same with the coordinates that are not `given` (n) as the constraints want them, near y; the others
/// stay as they are. No coordinate is left out that no constraint determines. Throws as consistent_state.
[[nodiscard]] Reals completed_state(const Dynamics& dynamics, const Reals& parameters, double t,
                                    const Reals& y, const std::vector<bool>& given);

}  // namespace qdot
