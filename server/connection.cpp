#include "server/connection.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace qdot::server {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto idle_limit = 2s;      // between two requests of one connection
constexpr auto first_grace = 250ms;  // for the first bytes of a new connection, whoever else waits
constexpr auto idle_slice = 10ms;    // how late an idle connection notices that it should give way
constexpr auto request_limit = 10s;  // first to last byte of a request
constexpr auto write_limit = 20s;
constexpr auto linger_limit = 1s;

// True when the socket is ready; false at the deadline.
bool wait_until(int socket, short events, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd entry{socket, events, 0};
    const int ready = ::poll(&entry, 1, static_cast<int>(std::max(left, 0ms).count()));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

constexpr auto phrases = std::to_array<std::pair<int, std::string_view>>({
    {200, "OK"},
    {204, "No Content"},
    {304, "Not Modified"},
    {400, "Bad Request"},
    {403, "Forbidden"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {406, "Not Acceptable"},
    {408, "Request Timeout"},
    {411, "Length Required"},
    {413, "Content Too Large"},
    {414, "URI Too Long"},
    {415, "Unsupported Media Type"},
    {417, "Expectation Failed"},
    {421, "Misdirected Request"},
    {422, "Unprocessable Content"},
    {431, "Request Header Fields Too Large"},
    {500, "Internal Server Error"},
    {503, "Service Unavailable"},
});

// RFC 9110, 15. A status line without a phrase is correct, too.
std::string_view reason_phrase(int status) {
  const auto* found = std::ranges::find(phrases, status, &std::pair<int, std::string_view>::first);
  return found == phrases.end() ? "" : found->second;
}

// A field value never carries a line end, whatever it was made of.
void append_field(std::string& head, std::string_view name, std::string_view value) {
  if (value.find_first_of("\r\n") != value.npos) return;
  head.append(name).append(": ").append(value).append("\r\n");
}

std::string response_head(const api::Response& response, bool last) {
  std::string head = "HTTP/1.1 " + std::to_string(response.status) + " ";
  head.append(reason_phrase(response.status)).append("\r\n");
  const bool bodiless = response.status == 204 || response.status == 304;
  if (!response.content_type.empty() && !bodiless) append_field(head, "Content-Type", response.content_type);
  if (!bodiless) append_field(head, "Content-Length", std::to_string(response.body.size()));
  for (const auto& [name, value] : response.headers) append_field(head, name, value);
  append_field(head, "Connection", last ? "close" : "keep-alive");
  return head + "\r\n";
}

}  // namespace

Connection::~Connection() {
  if (unread_body_) linger();
  ::close(socket_);
}

bool Connection::wait_for_request(const std::function<bool()>& give_up) {
  const auto start = Clock::now();
  const auto patience = start + (fresh_ ? first_grace : idle_slice);
  fresh_ = false;
  for (auto now = start; buffer_.empty(); now = Clock::now()) {
    if (wait_until(socket_, POLLIN, now + idle_slice)) return receive(now);
    if (now > start + idle_limit || (now > patience && give_up())) return false;
  }
  return true;
}

std::optional<Incoming> Connection::read_request() {
  const auto deadline = Clock::now() + request_limit;
  const auto late = [&] {
    return refuse(
        {api::ProblemKind::request_timeout, "The request did not arrive within 10 seconds.", {}, {}});
  };
  reusable_ = head_only_ = false;
  // RFC 9112, 2.2: an empty line before the request line is ignored.
  while (buffer_.starts_with("\r\n")) buffer_.erase(0, 2);
  std::size_t end = head_end(buffer_);
  while (end == buffer_.npos) {
    if (buffer_.size() > max_head_bytes) return refuse(oversized_head(buffer_));
    if (!receive(deadline)) return Clock::now() < deadline ? std::nullopt : std::optional(late());
    end = head_end(buffer_);
  }
  if (end > max_head_bytes) return refuse(oversized_head(std::string_view(buffer_).substr(0, end)));
  auto parsed = read_head(std::string_view(buffer_).substr(0, end));
  if (auto* refusal = std::get_if<Refusal>(&parsed)) return refuse(std::move(*refusal));
  auto& head = std::get<Head>(parsed);
  head_only_ = head.method == "HEAD";
  buffer_.erase(0, end);
  if (head.expects_continue && buffer_.size() < head.content_length) {
    if (!send("HTTP/1.1 100 Continue\r\n\r\n", deadline, 0)) return std::nullopt;
  }
  while (buffer_.size() < head.content_length) {
    if (!receive(deadline)) return Clock::now() < deadline ? std::nullopt : std::optional(late());
  }
  api::Request request{std::move(head.method), std::move(head.target), std::move(head.fields),
                       buffer_.substr(0, head.content_length), nullptr};
  buffer_.erase(0, head.content_length);
  reusable_ = head.keep_alive;
  return request;
}

Incoming Connection::refuse(Refusal refusal) {
  unread_body_ = true;
  head_only_ = refusal.method == "HEAD";
  return refusal;
}

void Connection::write_response(const api::Response& response, bool last) {
  const auto deadline = Clock::now() + write_limit;
  const bool bodiless =
      head_only_ || response.body.empty() || response.status == 204 || response.status == 304;
  // MSG_MORE: head and body leave in one packet when they fit.
  if (!send(response_head(response, last), deadline, bodiless ? 0 : MSG_MORE) ||
      (!bodiless && !send(response.body, deadline, 0))) {
    reusable_ = false;
  }
}

bool Connection::receive(Clock::time_point deadline) {
  std::array<char, 16384> bytes;
  for (;;) {
    const auto count = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (count > 0) {
      buffer_.append(bytes.data(), static_cast<std::size_t>(count));
      return true;
    }
    if (count == 0 || (errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK)) return false;
    if (!wait_until(socket_, POLLIN, deadline)) return false;
  }
}

bool Connection::send(std::string_view bytes, Clock::time_point deadline, int flags) {
  while (!bytes.empty()) {
    const auto count = ::send(socket_, bytes.data(), bytes.size(), flags | MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!wait_until(socket_, POLLOUT, deadline)) return false;
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

// Closing a socket with unread bytes resets it, and the client would lose the answer: read on for a moment.
void Connection::linger() {
  ::shutdown(socket_, SHUT_WR);
  const auto deadline = Clock::now() + linger_limit;
  do {
    buffer_.clear();
  } while (Clock::now() < deadline && receive(deadline));
}

}  // namespace qdot::server
