#pragma once
// One request on its way through the server, and the way back for its answer.

#include <atomic>
#include <chrono>
#include <functional>
#include <utility>
#include <variant>

#include "api/http/messages.hpp"
#include "server/framing.hpp"
#include "server/outgoing.hpp"

namespace qdot::server {

using Clock = std::chrono::steady_clock;

/// A request that a handler answers, or the reason why its bytes are not one.
using Incoming = std::variant<api::Request, Refusal>;

class Exchange {
 public:
  using Deliver = std::function<void(Outgoing)>;

  /// `deliver` is called once, from whichever thread answers; it must not throw.
  Exchange(Incoming incoming, Follow follow, Deliver deliver)
      : incoming(std::move(incoming)), follow(follow), deliver_(std::move(deliver)) {}

  /// If nobody has answered, because something was thrown on the way, the answer is a plain 500.
  ~Exchange() { answer(Outgoing::internal_error()); }
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// The first answer counts.
  void answer(Outgoing outgoing) {
    if (!std::exchange(answered_, true)) deliver_(std::move(outgoing));
  }

  /// Nobody waits for the answer any more.
  void abandon() { abandoned_ = true; }
  [[nodiscard]] bool abandoned() const { return abandoned_; }

  Incoming incoming;
  const Follow follow;                            ///< if the application sees no reason to close
  const Clock::time_point arrived{Clock::now()};  ///< when its last byte had come

 private:
  Deliver deliver_;
  std::atomic<bool> abandoned_{false};
  bool answered_{false};
};

}  // namespace qdot::server
