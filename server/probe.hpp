#pragma once
// `qdot health` and `qdot wait`: is a server there?

#include <chrono>
#include <string>

namespace qdot::server {

struct ProbeOptions {
  std::string host{"127.0.0.1"};
  int port{8080};
  std::string unix_socket{};                ///< a path, used in place of host and port
  std::chrono::milliseconds timeout{2000};  ///< for one probe
};

/// True when GET /healthz is answered with 200 in time.
[[nodiscard]] bool healthy(const ProbeOptions& options);

/// Probes until healthy() or for `patience`; true when it became healthy.
[[nodiscard]] bool wait_until_healthy(const ProbeOptions& options, std::chrono::milliseconds patience);

}  // namespace qdot::server
