#pragma once
// Listens, and gives each request to one handler: a request in, a response out. All that is known about the
// HTTP library and about threads of connections stays behind this header.

#include <functional>
#include <memory>
#include <string>

#include "server/connection.hpp"

namespace qdot::server {

struct TransportOptions {
  std::string host{"127.0.0.1"};
  int port{8080};       ///< 0: any free one
  int connections{64};  ///< served at a time; more wait, and idle ones give way to them
};

/// Called from many threads at a time. What it throws becomes a plain 500.
using Handler = std::function<api::Response(const Incoming&)>;

class Transport {
 public:
  /// Binds, so that the port is known and its own; throws std::runtime_error with the reason when it is not.
  Transport(const TransportOptions& options, Handler handler);
  ~Transport();

  [[nodiscard]] int port() const;

  /// Serves until stop(). Throws std::runtime_error when the listening socket fails.
  void run();

  /// From any thread, once run() was called or is about to be: accepts nothing more, closes idle connections;
  /// run() returns when what is in flight is answered.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace qdot::server
