#pragma once
// The access log: one JSON object a line.

#include <cstddef>
#include <cstdio>
#include <string_view>

namespace qdot::server {

struct LogEntry {
  std::string_view id;
  std::string_view method;
  std::string_view target;
  int status{0};
  std::size_t bytes{0};
  double milliseconds{0};
};

/// Writes the entry with the present time in one piece, so that lines of several threads do not mix.
void log_request(std::FILE* log, const LogEntry& entry);

}  // namespace qdot::server
