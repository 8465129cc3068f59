#pragma once

namespace qdot {

/// How a quantity passes through zero, with time running forwards.
enum class Crossing { rising, falling, either };

}  // namespace qdot
