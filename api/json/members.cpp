#include "api/json/members.hpp"

#include "api/json/documents.hpp"
#include "api/json/json.hpp"

namespace qdot::api {
namespace {

constexpr std::string_view between_members = " \t\r\n";

/// One past the string that begins at `at`.
std::size_t string_end(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return at + 1;
}

/// One past the value that begins at `at`.
std::size_t value_end(std::string_view text, std::size_t at) {
  int depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      at = string_end(text, at);
    } else {
      if (depth == 0 && (c == ',' || c == '}' || c == ']')) return at;
      if (c == '{' || c == '[') ++depth;
      if (c == '}' || c == ']') --depth;
      ++at;
    }
    if (depth == 0 && (c == '"' || c == '}' || c == ']')) return at;
  }
  return at;
}

}  // namespace

std::vector<std::pair<std::string, std::string_view>> members_of(std::string_view object) {
  std::vector<std::pair<std::string, std::string_view>> members;
  std::size_t at = object.find('{');
  while (at != std::string_view::npos) {
    const std::size_t key = object.find('"', at);
    if (key == std::string_view::npos) break;
    const std::size_t end_of_key = string_end(object, key);
    const std::size_t value = object.find_first_not_of(between_members, object.find(':', end_of_key) + 1);
    const std::size_t end = value_end(object, value);
    std::string_view text = object.substr(value, end - value);
    text = text.substr(0, text.find_last_not_of(between_members) + 1);
    members.emplace_back(parse_json(object.substr(key, end_of_key - key)).get<std::string>(), text);
    at = object.find_first_not_of(between_members, end);
    if (at != std::string_view::npos && object[at] != ',') break;
  }
  return members;
}

}  // namespace qdot::api
