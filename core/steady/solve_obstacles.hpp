#pragma once
// Why no value of the unknown u holds a position (core/steady/solve_for.hpp), in words.

#include <string>
#include <vector>

#include "core/numerics/interval.hpp"

namespace qdot {

enum class Obstacle {
  none,
  not_in_balance,   ///< a force does not vanish, whatever u is
  off_surface,      ///< a constraint does not hold, whatever u is
  dependent,        ///< the constraints depend on each other there
  does_not_matter,  ///< no force depends on u here
  undefined,        ///< the forces have no finite value
  no_finite_value,
  no_real_value,
  negative_square,  ///< u^2 would have to be negative
  none_in_domain,   ///< no zero of a force that is no polynomial of u
  not_decided,      ///< a force is too small to tell where it vanishes
  may_end,          ///< forces have values in a part of the line that is not told, and may vanish at its ends
  at_kink,          ///< the forces have no single value at the position, or their kinks move with u
  no_common_value,  ///< no value makes all the forces vanish
  at_pole,          ///< only where what the forces divide by is zero, too
  outside_domain,
  impossible_body  ///< its principal moments would be those of none
};

struct BalancingValue {
  Interval u;
  bool is_one{};  ///< proven; else there may be several within it, or none
};

/// Values that make the forces vanish; none with the obstacle and what its sentence names.
struct Candidates {
  Obstacle obstacle{Obstacle::none};
  std::vector<BalancingValue> values{};
  std::string name{};  ///< of coordinates out of balance, or of a constraint; or what is impossible
  double number{};
  std::vector<std::size_t> without_force{};  ///< those of the polynomial's that vanish whatever u is
};

/// Empty where there is no obstacle. `u`: the unknown's name; `position`: in words, empty where no force
/// depends on it.
[[nodiscard]] std::string sentence(const Candidates& found, const std::string& u,
                                   const std::string& position);

}  // namespace qdot
