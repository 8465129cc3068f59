#pragma once
// Numbers in sentences.

#include <string>

namespace qdot {

[[nodiscard]] std::string short_number(double x, int digits = 4);

}  // namespace qdot
