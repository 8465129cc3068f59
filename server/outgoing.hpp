#pragma once
// An answer as bytes on their way to a client.

#include <cstddef>
#include <string>
#include <string_view>

#include "api/service.hpp"

namespace qdot::server {

enum class Follow { close, keep_alive };
enum class Body { send, leave_out };

class Outgoing {
 public:
  Outgoing() = default;
  /// `body` is left out of the answer to HEAD, and of a 204 or a 304.
  Outgoing(api::Response response, Follow follow, Body body);

  /// The answer for the moment when there is no memory for any; made without allocating.
  [[nodiscard]] static Outgoing out_of_memory();

  enum class Progress { done, blocked, failed };
  /// Sends what the socket takes, without waiting.
  Progress send(int socket);

  [[nodiscard]] std::size_t size() const { return head_.size() + body_.size() + fixed_.size(); }
  [[nodiscard]] std::size_t sent() const { return sent_; }
  [[nodiscard]] Follow follow() const { return follow_; }

 private:
  std::string head_;
  std::string body_;
  std::string_view fixed_;
  std::size_t sent_{0};
  Follow follow_{Follow::close};
};

}  // namespace qdot::server
