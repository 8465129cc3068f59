#pragma once
// Listens, and gives each request to one handler: a request in, a response out. One thread polls all sockets
// and never waits for a client, so that slow ones, silent ones and those that do not read cost memory (which
// is bounded) and no worker.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/connection.hpp"
#include "server/exchange.hpp"

namespace qdot::server {

struct TransportOptions {
  std::string host{"127.0.0.1"};
  std::optional<int> port{};      ///< 0: any free one; none: no TCP
  std::string unix_socket{};      ///< path; empty: none
  std::size_t connections{1024};  ///< of one more, the one that has waited longest for a request is closed
  Patience patience{};
};

/// Called on the poller's thread: it must not wait. It answers the exchange at once, or keeps it for a thread
/// that does. What it throws becomes a plain 500.
using Handler = std::function<void(const std::shared_ptr<Exchange>&)>;

class Transport {
 public:
  /// Binds, so that the port is known and its own; throws std::runtime_error with the reason when it is not.
  Transport(const TransportOptions& options, Handler handler);
  ~Transport();

  /// 0 without TCP.
  [[nodiscard]] int port() const;

  /// Serves until stop(); the poller is the calling thread.
  void run();

  /// From any thread, once run() was called or is about to be: accepts nothing more, closes idle connections;
  /// run() returns when what is in flight is answered.
  void stop();

  struct Gauges {
    std::size_t connections{};
    std::size_t unsent_bytes{};  ///< of answers that clients have not read yet
  };
  [[nodiscard]] Gauges gauges() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace qdot::server
