#include "server/request_log.hpp"
#include "api/json/documents.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <ctime>

namespace qdot::server {
namespace {

constexpr std::size_t max_target = 200;  // bytes of a target in a line
constexpr std::size_t max_method = 16;

std::string utc_now() {
  const auto now = std::chrono::system_clock::now();
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count();
  const std::time_t seconds = milliseconds / 1000;
  std::tm fields{};
  gmtime_r(&seconds, &fields);
  std::array<char, 40> text;
  const auto length = std::strftime(text.data(), text.size(), "%FT%T", &fields);
  const auto fraction = std::to_string(1000 + milliseconds % 1000).substr(1);
  return std::string(text.data(), length) + "." + fraction + "Z";
}

bool stands_for_itself(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; }

std::string quoted(std::string_view text) {
  if (std::ranges::all_of(text, stands_for_itself)) return '"' + std::string(text) + '"';
  return api::dump_json_replacing(api::Json(text));
}

std::string rounded(double milliseconds) {
  std::array<char, 32> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), milliseconds, std::chars_format::fixed, 3)
          .ptr;
  return {digits.data(), end};
}

// Written by hand: under load a refusal costs little more than its line.
std::string line_of(const LogEntry& entry) {
  std::string line = "{\"time\":\"" + utc_now() + "\"";
  const auto add = [&](std::string_view name, const std::string& value) {
    line.append(",\"").append(name).append("\":").append(value);
  };
  add("id", quoted(entry.id));
  add("method", quoted(entry.method.substr(0, max_method)));
  add("target", quoted(entry.target.substr(0, max_target)));
  add("status", std::to_string(entry.status));
  add("bytes", std::to_string(entry.bytes));
  add("ms", rounded(entry.milliseconds));
  add("waited_ms", rounded(entry.waited));
  if (entry.abandoned) add("abandoned", "true");
  return line + "}\n";
}

}  // namespace

void RequestLog::write(const LogEntry& entry) {
  if (descriptor_ >= 0) write_line(line_of(entry));
}

void RequestLog::write_event(std::string_view event, const api::Json& members) {
  if (descriptor_ < 0) return;
  api::Json line{{"time", utc_now()}, {"event", event}};
  line.update(members);
  write_line(api::dump_json_replacing(line) + "\n");
}

// A pipe that is ready takes PIPE_BUF bytes in one piece, and a line is shorter.
void RequestLog::write_line(const std::string& text) {
  const std::lock_guard lock(mutex_);
  pollfd entry{descriptor_, POLLOUT, 0};
  const bool ready = ::poll(&entry, 1, 0) == 1 && (entry.revents & POLLOUT) != 0;
  if (!ready || ::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    ++dropped_;
}

}  // namespace qdot::server
