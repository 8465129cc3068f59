#pragma once
// What stands between the sockets and api::Service: how many compute at a time, draining, the request id and
// one log line a request. No sockets, so that it is tested by calling it.

#include <condition_variable>
#include <cstdio>
#include <functional>
#include <mutex>
#include <string>

#include "api/service.hpp"
#include "server/connection.hpp"

namespace qdot::server {

struct ApplicationOptions {
  int threads{1};           ///< requests that compute at a time
  int queue{48};            ///< requests that may wait for one of them; the next gets 503
  std::FILE* log{nullptr};  ///< one JSON object a line; nullptr: no log
};

class Application {
 public:
  /// `service` is api::Service::handle; another function in tests.
  using Service = std::function<api::Response(const api::Request&)>;

  Application(const ApplicationOptions& options, Service service);

  /// Thread-safe. Adds X-Request-Id and X-Content-Type-Options, and logs.
  [[nodiscard]] api::Response respond(const Incoming& incoming);

  /// From now on work is refused and /readyz says 503; returns when nothing computes or waits to compute.
  void drain();

 private:
  api::Response admit(const api::Request& request);
  api::Response compute(const api::Request& request);

  ApplicationOptions options_;
  Service service_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int computing_{0};
  int waiting_{0};
  bool draining_{false};
};

}  // namespace qdot::server
