#include "api/json/pointer.hpp"

namespace qdot::api {
namespace {

/// Whether RFC 3986 allows `c` in a fragment as it is. Not so % nor / and ~, which RFC 6901 escapes.
bool stands_for_itself(char c) {
  const bool letter_or_digit = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter_or_digit || std::string_view("-._!$&'()*+,;=:@?").find(c) != std::string_view::npos;
}

}  // namespace

std::string below(std::string pointer, std::string_view key) {
  constexpr std::string_view hexadecimal = "0123456789ABCDEF";
  if (key.size() > longest_key) return pointer;
  pointer += '/';
  for (const char c : key) {
    if (c == '~') {
      pointer += "~0";
    } else if (c == '/') {
      pointer += "~1";
    } else if (stands_for_itself(c)) {
      pointer += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      pointer += {'%', hexadecimal[byte >> 4U], hexadecimal[byte & 15U]};
    }
  }
  return pointer;
}

std::string below(std::string pointer, std::size_t index) { return pointer + "/" + std::to_string(index); }

}  // namespace qdot::api
