#include "server/outgoing.hpp"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace qdot::server {
namespace {

constexpr auto phrases = std::to_array<std::pair<int, std::string_view>>({
    {200, "OK"},
    {204, "No Content"},
    {304, "Not Modified"},
    {400, "Bad Request"},
    {401, "Unauthorized"},
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
  if (value.find_first_of(std::string_view("\r\n\0", 3)) != value.npos) return;
  head.append(name).append(": ").append(value).append("\r\n");
}

bool is_bodiless(int status) { return status == 204 || status == 304; }

std::string head_of(const api::Response& response, Follow follow) {
  std::string head = "HTTP/1.1 " + std::to_string(response.status) + " ";
  head.append(reason_phrase(response.status)).append("\r\n");
  if (!is_bodiless(response.status)) {
    if (!response.content_type.empty()) append_field(head, "Content-Type", response.content_type);
    append_field(head, "Content-Length", std::to_string(response.body.size()));
  }
  for (const auto& [name, value] : response.headers) append_field(head, name, value);
  append_field(head, "Connection", follow == Follow::close ? "close" : "keep-alive");
  return head + "\r\n";
}

constexpr std::string_view no_memory =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Type: application/problem+json\r\nContent-Length: 148\r\n"
    "Retry-After: 1\r\nX-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n"
    "{\"type\":\"/errors/overloaded\",\"title\":\"Too much is waiting already\",\"status\":503,"
    "\"detail\":\"There is no memory or no connection left.\",\"instance\":\"\"}\n";
static_assert(no_memory.size() - no_memory.find("\r\n\r\n") - 4 == 148, "the Content-Length above");

}  // namespace

Outgoing::Outgoing(api::Response response, Follow follow, Body body)
    : head_(head_of(response, follow)), follow_(follow) {
  if (body == Body::send && !is_bodiless(response.status)) body_ = std::move(response.body);
}

Outgoing Outgoing::out_of_memory() {
  Outgoing result;
  result.fixed_ = no_memory;
  return result;
}

Outgoing::Progress Outgoing::send(int socket) {
  while (sent_ < size()) {
    std::array<std::string_view, 3> parts{fixed_, head_, body_};
    std::array<iovec, 3> vectors{};
    std::size_t skipped = sent_;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto cut = std::min(skipped, parts[i].size());
      skipped -= cut;
      vectors[i] = {const_cast<char*>(parts[i].data()) + cut, parts[i].size() - cut};
    }
    msghdr message{};
    message.msg_iov = vectors.data();
    message.msg_iovlen = vectors.size();
    const auto count = ::sendmsg(socket, &message, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count >= 0) {
      sent_ += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return Progress::blocked;
    } else if (errno != EINTR) {
      return Progress::failed;
    }
  }
  return Progress::done;
}

}  // namespace qdot::server
