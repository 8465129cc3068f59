#pragma once
// Sockets that listen: TCP on an address, or a Unix socket that only its owner may use.

#include <string>

#include "server/descriptor.hpp"

namespace qdot::server {

/// Non-blocking, with room for 1024 clients that nobody has accepted yet. Port 0 takes any free one. Throws
/// std::runtime_error with the reason.
[[nodiscard]] Descriptor listen_on(const std::string& host, int port);

/// The port of a TCP listener.
[[nodiscard]] int port_of(const Descriptor& listener);

/// A Unix socket at `path`, mode 0600. A socket file that nobody listens on any more is replaced; anything
/// else at the path is an error.
[[nodiscard]] Descriptor listen_on_unix(const std::string& path);

}  // namespace qdot::server
