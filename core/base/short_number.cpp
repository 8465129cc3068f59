#include "core/base/short_number.hpp"

#include <charconv>

namespace qdot {

std::string short_number(double x, int digits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x, std::chars_format::general, digits).ptr;
  return {text, end};
}

}  // namespace qdot
