#pragma once
// An answer as bytes on their way to a client. It is ours because httplib waits in a thread until the client
// has read; here a slow reader costs memory only, and of that no more than is not sent.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace qdot::server {

/// What the client may do with the connection after the answer.
enum class Follow { close, keep_alive };

class Outgoing {
 public:
  Outgoing() = default;
  /// `head` ends with its empty line.
  Outgoing(std::string head, std::string body, Follow follow)
      : head_(std::move(head)), body_(std::move(body)), follow_(follow) {}

  /// Answers for when no other can be made. They need no memory, and close the connection.
  [[nodiscard]] static Outgoing out_of_memory();
  [[nodiscard]] static Outgoing internal_error();

  enum class Progress { done, blocked, failed };
  /// Sends what the socket takes, without waiting.
  Progress send(int socket);

  [[nodiscard]] std::string_view head() const { return head_; }
  [[nodiscard]] std::string_view body() const { return body_; }
  [[nodiscard]] std::size_t unsent() const { return fixed_.size() + head_.size() + body_.size() - sent_; }
  [[nodiscard]] std::size_t sent() const { return sent_; }
  [[nodiscard]] Follow follow() const { return follow_; }

 private:
  explicit Outgoing(std::string_view fixed) : fixed_(fixed) {}
  void give_back_sent();

  std::string_view fixed_;  // in place of head and body
  std::string head_;
  std::string body_;
  std::size_t sent_{0};
  std::size_t given_back_{0};  // of the body
  Follow follow_{Follow::close};
};

}  // namespace qdot::server
