#pragma once
// Listens, and gives each request to one handler. One thread polls all sockets and never waits for a client,
// so that clients who are slow, silent or do not read cost memory, which is bounded, and no worker. It is
// ours because httplib waits in a worker for each of them: eight that send a byte a second stop it.

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
  std::optional<int> port{};      ///< 0 takes any free one; without a value there is no TCP
  std::string unix_socket{};      ///< its path; if empty there is none
  std::size_t connections{1024};  ///< for one more, the one that has waited longest for a request is closed
  std::size_t unsent_bytes{std::size_t{64}
                           << 20};  ///< while more than this waits to be read, slow readers are cut off
  Patience patience{};
};

/// Is called on the poller's thread, so it must not wait. It answers the exchange at once, or keeps it for a
/// thread that will. If it throws, the client gets a plain 500.
using Handler = std::function<void(const std::shared_ptr<Exchange>&)>;

class Transport {
 public:
  /// Binds at once, so that port() is known; throws std::runtime_error with the reason if it cannot.
  Transport(const TransportOptions& options, Handler handler);
  ~Transport();

  /// 0 if there is no TCP.
  [[nodiscard]] int port() const;

  /// Serves until stop(); the poller is the calling thread.
  void run();

  /// From any thread, once run() was called or is about to be: accepts nothing more, closes idle connections;
  /// run() returns when what is in flight is answered.
  void stop();

  /// From the handler: the poller looks away for some milliseconds after this round. What comes meanwhile is
  /// then read at one time, and the threads that compute are not interrupted for each request that is
  /// refused.
  void rest();

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
