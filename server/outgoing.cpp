#include "server/outgoing.hpp"

#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>

namespace qdot::server {
namespace {

constexpr std::string_view no_memory =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Type: application/problem+json\r\nContent-Length: "
    "148\r\nRetry-After: 1\r\nX-Content-Type-Options: nosniff\r\nConnection: "
    "close\r\n\r\n{\"type\":\"/errors/overloaded\",\"title\":\"Too much is waiting "
    "already\",\"status\":503,\"detail\":\"There is no memory or no connection left.\",\"instance\":\"\"}\n";
static_assert(no_memory.size() - no_memory.find("\r\n\r\n") - 4 == 148, "the Content-Length above");

constexpr std::size_t least_given_back = 1 << 20;  // bytes, so that the kernel is not asked for every page

constexpr std::string_view error =
    "HTTP/1.1 500 Internal Server Error\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";

}  // namespace

Outgoing Outgoing::out_of_memory() { return Outgoing(no_memory); }
Outgoing Outgoing::internal_error() { return Outgoing(error); }

Outgoing::Progress Outgoing::send(int socket) {
  while (unsent() > 0) {
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
      give_back_sent();
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return Progress::blocked;
    } else if (errno != EINTR) {
      return Progress::failed;
    }
  }
  return Progress::done;
}

/// The pages of the body that nobody will read again; the kernel gives zeros in their place. Source:
/// madvise(2).
void Outgoing::give_back_sent() {
  constexpr std::size_t page = 65536;  // or a part of it, on every processor
  const std::size_t before = head_.size();
  const std::size_t sent = sent_ > before ? sent_ - before : 0;
  if (sent < given_back_ + least_given_back) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(body_.data());
  const std::uintptr_t from = (begin + given_back_ + page - 1) / page * page,
                       to = (begin + sent) / page * page;
  ::madvise(reinterpret_cast<void*>(from), to - from, MADV_DONTNEED);
  given_back_ = to - begin;
}

}  // namespace qdot::server
