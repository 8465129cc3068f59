#pragma once
// The direction in which a quantity g(t) passes through zero as time runs forwards: `rising` from g < 0 to
// g > 0, `falling` from g > 0 to g < 0.

namespace qdot {

enum class Crossing { rising, falling, either };

}  // namespace qdot
