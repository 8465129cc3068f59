#pragma once
// `qdot serve`: the service behind a port until a signal ends it.

#include <string>

namespace qdot::server {

struct ServeOptions {
  std::string host{"127.0.0.1"};
  int port{8080};      ///< 0: any free one
  int threads{0};      ///< requests that compute at a time; 0: the number of cores
  std::string scenes;  ///< directory of more scenes; empty: none
};

/// Prints one JSON line {"listening", "port"} on stdout once clients can connect, then serves. SIGTERM or
/// SIGINT: what is in flight is finished, then it returns; a second one ends the process at once.
/// Call it before any other thread exists. Throws std::runtime_error when it cannot start.
void serve(const ServeOptions& options);

}  // namespace qdot::server
