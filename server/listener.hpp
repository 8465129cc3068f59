#pragma once
// Sockets that listen: TCP on an address, or a Unix socket that only its owner may use. They are ours because
// httplib lets five clients wait where we let 1024, and does not say why it cannot listen.

#include <string>

#include "server/descriptor.hpp"

namespace qdot::server {

/// The socket does not block, and 1024 clients can wait to be accepted. Port 0 takes any free one. Throws
/// std::runtime_error with the reason.
[[nodiscard]] Descriptor listen_on(const std::string& host, int port);

/// The port of a TCP listener.
[[nodiscard]] int port_of(const Descriptor& listener);

/// A Unix socket at `path` with mode 0600. Replaces a socket file that nobody listens on any more; throws
/// std::runtime_error if anything else is there.
[[nodiscard]] Descriptor listen_on_unix(const std::string& path);

}  // namespace qdot::server
