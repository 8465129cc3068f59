#include "api/json/pointer.hpp"

#include <charconv>
#include <limits>

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

std::optional<std::vector<std::string>> steps_of(std::string_view pointer) {
  if (!pointer.starts_with('/')) return std::nullopt;
  std::vector<std::string> steps;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    std::string step;
    for (; !pointer.empty() && pointer[0] != '/'; pointer.remove_prefix(1)) {
      const bool is_escape = pointer[0] == '~';
      if (is_escape && (pointer.size() < 2 || (pointer[1] != '0' && pointer[1] != '1'))) return std::nullopt;
      step += is_escape ? (pointer[1] == '0' ? '~' : '/') : pointer[0];
      if (is_escape) pointer.remove_prefix(1);
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

bool is_made_of_digits(std::string_view step) {
  return !step.empty() && step.find_first_not_of("0123456789") == std::string_view::npos;
}

std::optional<std::size_t> index_of(std::string_view step) {
  if (!is_made_of_digits(step) || (step.starts_with('0') && step.size() > 1)) return std::nullopt;
  std::size_t index{};
  const auto error = std::from_chars(step.data(), step.data() + step.size(), index).ec;
  const bool is_counted = error == std::errc() && index < std::numeric_limits<std::size_t>::max();
  return is_counted ? std::optional(index) : std::nullopt;
}

const Json* child_at(const Json& from, const std::string& step) {
  if (from.is_object()) {
    const auto found = from.find(step);
    return found == from.end() ? nullptr : &*found;
  }
  if (!from.is_array()) return nullptr;
  const auto index = index_of(step);
  return index && *index < from.size() ? &from[*index] : nullptr;
}

}  // namespace qdot::api
