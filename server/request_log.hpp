#pragma once
// The log: one JSON object a line. It never holds up a request: if the other end is full, closed or slow and
// does not take a line at once, the line is dropped and counted.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "api/json/json.hpp"

namespace qdot::server {

struct LogEntry {
  std::string_view id;
  std::string_view method;
  std::string_view target;
  int status{0};
  std::size_t bytes{0};
  double milliseconds{0};  ///< from the last byte of the request to the answer
  double waited{0};        ///< how many of these milliseconds it stood in a queue
  bool abandoned{false};   ///< the client left before
};

class RequestLog {
 public:
  /// `descriptor` stays the caller's; if it is negative there is no log.
  explicit RequestLog(int descriptor) : descriptor_(descriptor) {}

  void write(const LogEntry& entry);
  /// Logs something other than a request: {"time": ..., "event": ..., and `members`}.
  void write_event(std::string_view event, const api::Json& members);

  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  void write_line(const std::string& text);

  int descriptor_;
  std::mutex mutex_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace qdot::server
