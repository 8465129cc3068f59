#pragma once
// Momenta of ignorable coordinates while a parameter moves. They are those of the start, whose velocities or
// inertia may speak of the parameter: a top that is spun at n has C n.

#include <memory>

#include "core/dynamics/dynamics.hpp"

namespace qdot {

/// A state (q, q') and the parameters for which it was asked.
struct Start {
  const Reals &parameters, &y;
};

/// The statics for `there` with these momenta put in as expressions of the parameters, in a graph of their
/// own. Null where none of them depends on parameter number `index`, and where they are not those of the
/// scene's start.
[[nodiscard]] std::shared_ptr<const Statics> with_followed_momenta(const Dynamics& dynamics,
                                                                   const Reals& there, const Start& start,
                                                                   std::size_t index);

/// The same wherever momenta have expressions.
[[nodiscard]] std::shared_ptr<const Statics> with_written_momenta(const Dynamics& dynamics,
                                                                  const Reals& there, const Start& start);

}  // namespace qdot
