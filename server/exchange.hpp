#pragma once
// One request on its way through the server, and the way back for its answer.

#include <atomic>
#include <chrono>
#include <functional>
#include <variant>

#include "api/service.hpp"
#include "server/framing.hpp"

namespace qdot::server {

using Clock = std::chrono::steady_clock;

/// A request that a handler answers, or the reason why its bytes are not one.
using Incoming = std::variant<api::Request, Refusal>;

class Exchange {
 public:
  using Deliver = std::function<void(api::Response)>;

  /// `deliver` is called once, from whichever thread answers.
  Exchange(Incoming incoming, Deliver deliver)
      : incoming(std::move(incoming)), deliver_(std::move(deliver)) {}

  /// What nobody answered, because something was thrown on the way, becomes a plain 500.
  ~Exchange();
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// The first answer counts.
  void answer(api::Response response);
  /// Answers that there is no memory; needs none.
  void answer_out_of_memory() { answer(out_of_memory()); }

  /// The response that the transport says in its own words.
  [[nodiscard]] static api::Response out_of_memory() { return {.status = 0}; }

  /// Nobody waits for the answer any more.
  void abandon() { abandoned_ = true; }
  [[nodiscard]] bool abandoned() const { return abandoned_; }

  Incoming incoming;
  const Clock::time_point arrived{Clock::now()};  ///< when its last byte had come

 private:
  Deliver deliver_;
  std::atomic<bool> abandoned_{false};
  bool answered_{false};
};

}  // namespace qdot::server
