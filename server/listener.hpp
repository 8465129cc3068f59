#pragma once
// Sockets that listen: TCP on an address, or a Unix socket that only its owner may use. They are ours because
// httplib lets five clients wait where we let 1024, and does not say why it cannot listen.

#include <stdexcept>
#include <string>

#include "server/descriptor.hpp"

namespace qdot::server {

/// The address cannot be had: what() says why.
struct CannotListen : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The socket does not block, and 1024 clients can wait to be accepted. Port 0 takes any free one. Throws
/// CannotListen with the reason.
[[nodiscard]] Descriptor listen_on(const std::string& host, int port);

/// The port of a TCP listener.
[[nodiscard]] int port_of(const Descriptor& listener);

/// A Unix socket at `path` with mode 0600. Replaces a socket file that nobody listens on any more; throws
/// CannotListen if anything else is there.
[[nodiscard]] Descriptor listen_on_unix(const std::string& path);

}  // namespace qdot::server
