#pragma once
// Events with an impact that a motion of one coordinate comes to, of which its energy integral knows nothing:
// a ball turns at the floor.

#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/numerics/box.hpp"
#include "core/turning/enclosed_motion.hpp"

namespace qdot {

/// Their functions, which vanish at the impact.
[[nodiscard]] std::vector<Column> impact_columns(const Model& model);

/// The first that depends on one of these symbols; empty: none does.
[[nodiscard]] std::string impact_that_depends(const std::vector<Column>& impacts,
                                              const std::vector<Expression>& symbols);

/// The first that the motion comes to, or may come to. Empty: it comes to none. `motion`: along the columns.
[[nodiscard]] std::string impact_along(EnclosedMotion& motion, const std::vector<Column>& impacts);

/// The first that may vanish in a state (q, q') of the box; empty: none does.
[[nodiscard]] std::string impact_within(const Dynamics& dynamics, const Reals& parameters, const Box& states,
                                        const std::vector<Column>& impacts);

}  // namespace qdot
