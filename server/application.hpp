#pragma once
// What stands between the sockets and api::Service: it decides who may ask, what is answered at once and
// which lane computes the rest; it keeps deadlines, drains, gives each request an id, counts it and logs one
// line. It has no sockets, so that tests just call it. httplib would compute in whichever thread has read the
// request; here the lanes are ours, because a health check must not wait behind a simulation.

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "api/http/messages.hpp"
#include "server/access.hpp"
#include "server/exchange.hpp"
#include "server/lanes.hpp"
#include "server/metrics.hpp"
#include "server/request_log.hpp"

namespace qdot::server {

struct ApplicationOptions {
  LanesOptions lanes{};
  HostsOptions hosts{};
  std::string token{};                                ///< if empty, no token is wanted
  Clock::duration deadline{std::chrono::seconds(8)};  ///< from a request's last byte to its answer
  Clock::duration drain{std::chrono::seconds(10)};    ///< how long work may go on after the end was asked for
  std::size_t unsent_bytes{std::size_t{64}
                           << 20};  ///< while more than this waits to be read, no work is
                                    ///< taken on or begun; light work while twice as much does
};

/// What it needs of the rest of the program; functions, so that tests can bring their own.
struct ApplicationParts {
  std::function<api::Response(const api::Request&)> answer;     ///< api::Service::handle
  std::function<api::Appraisal(const api::Request&)> appraise;  ///< api::Service::appraise
  std::function<std::size_t()> unsent_bytes{[] { return std::size_t{0}; }};
  std::function<void()> overloaded{[] {}};  ///< light work was refused
};

class Application {
 public:
  Application(const ApplicationOptions& options, ApplicationParts parts, RequestLog& log, Metrics& metrics);

  /// Any thread may call it, and it never waits: it answers at once or lets a lane do so.
  void handle(const std::shared_ptr<Exchange>& exchange);

  /// From now on work is refused and /readyz says 503; returns when nothing computes or waits to compute.
  void drain();
  [[nodiscard]] bool draining() const { return draining_; }

  [[nodiscard]] const Lanes& lanes() const { return lanes_; }

 private:
  struct Case;  // one request with what is known of it
  struct Sent;  // what of its answer is counted and logged
  void receive(const std::shared_ptr<Exchange>& exchange);
  void admit(Case& it);
  void compute(Case& it);
  void shed(Case& it);
  [[nodiscard]] bool has_room(Lane lane) const;
  void finish(Case& it, api::Response response);
  void send(Case& it, const Sent& sent, Outgoing outgoing);
  void record(const Case& it, const Sent& sent, std::size_t bytes);
  [[nodiscard]] Follow follow(const Case& it) const;

  ApplicationOptions options_;
  ApplicationParts parts_;
  Access access_;
  RequestLog& log_;
  Metrics& metrics_;
  std::atomic<bool> draining_{false};
  std::atomic<Clock::rep> drained_by_{Clock::time_point::max().time_since_epoch().count()};
  Lanes lanes_;
};

}  // namespace qdot::server
