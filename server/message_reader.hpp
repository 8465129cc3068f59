#pragma once
// Bytes go in, requests come out: those of one connection, one after the other, however their bytes are cut.
// httplib would wait in a thread for the rest of a request; this keeps what has come, and knows neither
// sockets nor time.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "server/exchange.hpp"
#include "server/framing.hpp"

namespace qdot::server {

class MessageReader {
 public:
  void append(std::string_view bytes) { buffer_.append(bytes); }

  /// The next request once it is whole. After a Refusal nothing can follow.
  [[nodiscard]] std::optional<Incoming> next();

  /// The head of a request whose body is not complete; nullptr elsewhere.
  [[nodiscard]] const Head* head() const { return head_ ? &*head_ : nullptr; }
  /// True while nothing of a request has arrived.
  [[nodiscard]] bool idle() const { return !head_ && buffer_.empty(); }
  /// May another request follow the one that came last?
  [[nodiscard]] bool keep_alive() const { return keep_alive_; }

 private:
  std::optional<Incoming> read_head_of_next();

  std::string buffer_;      // bytes not yet used; they may hold the beginning of the next request
  std::size_t scanned_{0};  // no head ends before this place
  std::optional<Head> head_;
  bool keep_alive_{false};
};

}  // namespace qdot::server
