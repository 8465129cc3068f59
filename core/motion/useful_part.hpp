#pragma once
// The horizon of a motion is the last instant up to which its columns are of use, as an error that grows
// leaves less and less of them.

namespace qdot {

/// A column is of use while its error is below this part of its largest magnitude.
inline constexpr double useful_part = 1e-3;

}  // namespace qdot
