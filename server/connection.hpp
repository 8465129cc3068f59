#pragma once
// One client's socket: requests in, responses out, every wait bounded. Knows framing, no library and no
// paths.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "api/service.hpp"
#include "server/framing.hpp"

namespace qdot::server {

/// A request that a handler answers, or the reason why its bytes are not one.
using Incoming = std::variant<api::Request, Refusal>;

class Connection {
 public:
  /// Takes the socket over and closes it at the end.
  explicit Connection(int socket) noexcept : socket_(socket) {}
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Waits until the next request begins. False when the client has gone, when it was idle for too long, or
  /// as soon as `give_up` says that the wait is not worth its thread (a new client is given a moment first).
  [[nodiscard]] bool wait_for_request(const std::function<bool()>& give_up);

  /// The next request, within one deadline for the whole of it. Nothing when the client has gone.
  [[nodiscard]] std::optional<Incoming> read_request();

  /// Writes the answer to what was read last; `last` announces that the connection closes after it.
  void write_response(const api::Response& response, bool last);

  /// True when another request may follow the one that was read last.
  [[nodiscard]] bool reusable() const { return reusable_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool receive(Clock::time_point deadline);
  bool send(std::string_view bytes, Clock::time_point deadline, int flags);
  Incoming refuse(Refusal refusal);
  void linger();

  int socket_;
  std::string buffer_;  // received and not yet used; may hold the beginning of the next request
  bool fresh_{true};    // nothing has arrived yet
  bool head_only_{false};
  bool reusable_{false};
  bool unread_body_{false};
};

}  // namespace qdot::server
