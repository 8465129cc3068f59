#pragma once
// Where a motion's horizon is.

namespace qdot {

/// A column is of use while its error is below this part of its largest magnitude.
inline constexpr double useful_part = 1e-3;

}  // namespace qdot
