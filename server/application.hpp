#pragma once
// What stands between the sockets and api::Service: who may ask, what is answered at once, what is computed
// in which lane, deadlines, draining, the request id and one log line a request. No sockets, so that it is
// tested by calling it.

#include <atomic>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "api/service.hpp"
#include "server/exchange.hpp"
#include "server/lanes.hpp"

namespace qdot::server {

struct ApplicationOptions {
  LanesOptions lanes{};
  Clock::duration deadline{std::chrono::seconds(8)};  ///< from a request's last byte to its answer
  std::FILE* log{nullptr};                            ///< one JSON object a line; nullptr: no log
};

class Application {
 public:
  /// `service` is api::Service::handle; another function in tests.
  using Service = std::function<api::Response(const api::Request&)>;

  Application(const ApplicationOptions& options, Service service);

  /// Thread-safe, and never waits: answers at once or lets a lane do it. Adds X-Request-Id and
  /// X-Content-Type-Options, and logs.
  void handle(const std::shared_ptr<Exchange>& exchange);

  /// From now on work is refused and /readyz says 503; returns when nothing computes or waits to compute.
  void drain();

 private:
  struct Case;  // one request with what is known of it
  void compute(Case& it);
  void finish(Case& it, api::Response response);

  ApplicationOptions options_;
  Service service_;
  std::atomic<bool> draining_{false};
  Lanes lanes_;
};

}  // namespace qdot::server
