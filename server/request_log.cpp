#include "server/request_log.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string>

namespace qdot::server {
namespace {

constexpr std::size_t max_target = 200;  // bytes of a target in a line

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

}  // namespace

void log_request(std::FILE* log, const LogEntry& entry) {
  const nlohmann::ordered_json line{{"time", utc_now()},
                                    {"id", entry.id},
                                    {"method", entry.method.substr(0, 16)},
                                    {"target", entry.target.substr(0, max_target)},
                                    {"status", entry.status},
                                    {"bytes", entry.bytes},
                                    {"ms", std::round(entry.milliseconds * 1000) / 1000}};
  const auto text = line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  std::fwrite(text.data(), 1, text.size(), log);
}

}  // namespace qdot::server
