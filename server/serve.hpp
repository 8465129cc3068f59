#pragma once
// `qdot serve`: the service behind a port until a signal ends it.

#include <optional>
#include <string>
#include <vector>

namespace qdot::server {

struct ServeOptions {
  std::string host{"127.0.0.1"};
  std::optional<int> port{};  ///< 0 takes any free one; the default is 8080, or no TCP beside a Unix socket
  std::string unix_socket{};  ///< its path; if empty there is none
  int threads{0};             ///< how many requests compute at a time; 0 means the number of cores
  double deadline{8};         ///< seconds from a request's last byte to its answer
  std::vector<std::string> allowed_hosts{};  ///< more names that Host may have
  std::string token{};                       ///< what clients have to bring; if empty, nothing
  std::string scenes{};                      ///< a directory of more scenes; may be empty
};

/// Prints one JSON line {"listening", "port"} on stdout once clients can connect, then serves. SIGTERM or
/// SIGINT: what is in flight is finished, then it returns; a second one ends the process at once.
/// Call it before any other thread exists. Throws std::runtime_error when it cannot start.
void serve(const ServeOptions& options);

}  // namespace qdot::server
