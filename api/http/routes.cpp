#include "api/http/routes.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace qdot::api {
namespace {

std::string_view take_segment(std::string_view& path) {
  path.remove_prefix(1);  // the slash
  const std::string_view segment = path.substr(0, path.find('/'));
  path.remove_prefix(segment.size());
  return segment;
}

/// What the names of `pattern` stand for in `path`; no value when it does not fit.
std::optional<std::vector<std::string>> captures(std::string_view pattern, std::string_view path) {
  std::vector<std::string> result;
  while (pattern.starts_with('/') && path.starts_with('/')) {
    const std::string_view expected = take_segment(pattern);
    const std::string_view given = take_segment(path);
    if (expected.starts_with('{') && !given.empty()) {
      result.emplace_back(given);
    } else if (expected != given) {
      return std::nullopt;
    }
  }
  return pattern.empty() && path.empty() ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace

void Timing::lap(std::string_view name) {
  const Clock::time_point now = Clock::now();
  laps_.emplace_back(name, std::chrono::duration<double, std::milli>(now - last_).count());
  last_ = now;
}

std::string Timing::header() const {
  std::string text;
  for (const auto& [name, milliseconds] : laps_) {
    char digits[32];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, milliseconds, std::chars_format::fixed, 3).ptr;
    text += (text.empty() ? "" : ", ") + name + ";dur=" + std::string(digits, end);
  }
  return text;
}

Routes::Match Routes::match(std::string_view method, std::string_view path) const {
  const std::string_view wanted = method == "HEAD" ? "GET" : method;
  Match match;
  for (const Route& route : all_) {
    const std::string_view pattern = route.pattern;
    if (!path.starts_with(pattern.substr(0, pattern.find('{')))) continue;  // as nearly all
    auto found = captures(route.pattern, path);
    if (!found) continue;
    if (route.method == wanted) {
      match.route = &route;
      match.captures = std::move(*found);
    }
    match.allow += route.method + (route.method == "GET" ? ", HEAD, " : ", ");
  }
  if (!match.allow.empty()) match.allow += "OPTIONS";
  return match;
}

}  // namespace qdot::api
