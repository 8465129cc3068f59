#include "server/message_reader.hpp"

#include <algorithm>
#include <utility>

namespace qdot::server {

std::optional<Incoming> MessageReader::read_head_of_next() {
  // RFC 9112, 2.2: an empty line before the request line is ignored.
  while (buffer_.starts_with("\r\n")) buffer_.erase(0, 2);
  const std::string_view bytes = buffer_;
  auto end = head_end(bytes.substr(scanned_));
  if (end == bytes.npos) {
    scanned_ = std::max(bytes.size(), std::size_t{3}) - 3;  // the last bytes may be half of an empty line
    if (bytes.size() > max_head_bytes) return oversized_head(bytes);
    return std::nullopt;
  }
  end += std::exchange(scanned_, 0);
  if (end > max_head_bytes) return oversized_head(bytes.substr(0, end));
  auto parsed = read_head(bytes.substr(0, end));
  if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
  head_ = std::move(std::get<Head>(parsed));
  buffer_.erase(0, end);
  return std::nullopt;
}

std::optional<Incoming> MessageReader::next() {
  if (!head_) {
    keep_alive_ = false;
    if (auto refusal = read_head_of_next()) return refusal;
  }
  if (!head_ || buffer_.size() < head_->content_length) return std::nullopt;
  keep_alive_ = head_->keep_alive;
  api::Request request{.method = std::move(head_->method),
                       .target = std::move(head_->target),
                       .headers = std::move(head_->fields),
                       .body = buffer_.substr(0, head_->content_length)};
  buffer_.erase(0, head_->content_length);
  head_.reset();
  return request;
}

}  // namespace qdot::server
