#include "server/connection.hpp"

#include <linux/sockios.h>
#include <sys/epoll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace qdot::server {
namespace {

constexpr std::size_t small_body = 16 * 1024;   // of fewer bytes no account is kept
constexpr std::size_t write_slice = 64 * 1024;  // bytes that must go out within Patience::write
constexpr std::size_t most_discarded =
    64 << 20;  // bytes of a refused body that are read before the connection is cut

Refusal too_slow() {
  return {api::ProblemKind::request_timeout, "The request did not arrive in time.", {}, {}};
}

Refusal too_many_bodies(const Head& head) {
  return {api::ProblemKind::overloaded, "Too many large bodies are on their way.", head.method, head.target};
}

enum class Receipt { bytes, nothing_now, end };

Receipt receipt_of(ssize_t count) {
  if (count > 0) return Receipt::bytes;
  return count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK) ? Receipt::nothing_now : Receipt::end;
}

ssize_t receive(int socket, void* bytes, std::size_t size, int flags) {
  ssize_t count = 0;
  do count = ::recv(socket, bytes, size, MSG_DONTWAIT | flags);
  while (count < 0 && errno == EINTR);
  return count;
}

}  // namespace

Connection::Connection(Descriptor socket, const Patience& patience, Budget& bodies, Clock::time_point now)
    : socket_(std::move(socket)), patience_(patience), bodies_(bodies), deadline_(now + patience.request) {}

void Connection::note(std::uint32_t events, Clock::time_point now) {
  if ((events & (EPOLLIN | EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0) {
    readable_ = true;
    *has_more_ = true;
  }
  if ((events & (EPOLLHUP | EPOLLERR)) != 0) {
    gone_at_ = now;
  } else if ((events & EPOLLRDHUP) != 0 && !gone_at_) {
    gone_at_ = now + patience_.farewell;
  }
}

std::optional<Incoming> Connection::advance(Clock::time_point now) {
  if (state_ == State::writing) write(now);
  if (state_ == State::lingering) discard();
  if (state_ == State::waiting || state_ == State::reading) return read(now);
  return std::nullopt;
}

std::optional<Incoming> Connection::read(Clock::time_point now) {
  for (;;) {
    if (auto incoming = take_request(now)) return incoming;
    if (state_ == State::closed || !readable_) return std::nullopt;
    std::array<char, 16384> bytes;
    const auto count = receive(socket(), bytes.data(), bytes.size(), 0);
    switch (receipt_of(count)) {
      case Receipt::bytes:
        reader_.append({bytes.data(), static_cast<std::size_t>(count)});
        // A read that does not fill the buffer has taken all there was. epoll will report more bytes, but it
        // has reported the end already.
        readable_ = static_cast<std::size_t>(count) == bytes.size() || gone_at_.has_value();
        break;
      case Receipt::nothing_now:
        readable_ = false;
        return std::nullopt;
      case Receipt::end:
        close();
        return std::nullopt;
    }
  }
}

std::optional<Incoming> Connection::take_request(Clock::time_point now) {
  if (auto incoming = reader_.next()) return begin(std::move(*incoming));
  if (reader_.idle()) return std::nullopt;
  if (state_ == State::waiting) {
    state_ = State::reading;
    begun_ = now;
    deadline_ = now + patience_.head;
    head_seen_ = false;
  }
  const Head* head = reader_.head();
  if (head == nullptr || std::exchange(head_seen_, true)) return std::nullopt;
  deadline_ = begun_ + patience_.request;
  if (head->content_length > small_body && !(body_share_ = bodies_.take(head->content_length)))
    return begin(too_many_bodies(*head));
  if (head->expects_continue) {
    constexpr std::string_view go_on = "HTTP/1.1 100 Continue\r\n\r\n";
    if (::send(socket(), go_on.data(), go_on.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) close();
  }
  return std::nullopt;
}

Incoming Connection::begin(Incoming incoming) {
  state_ = State::answering;
  refused_ = std::holds_alternative<Refusal>(incoming);
  follow_ = !refused_ && reader_.keep_alive() ? Follow::keep_alive : Follow::close;
  fresh_ = false;
  *has_more_ = readable_ || !reader_.idle();
  return incoming;
}

std::optional<Incoming> Connection::expire(Clock::time_point now) {
  if (state_ == State::answering) {
    if (gone_at_ && now >= *gone_at_) {
      if (const auto exchange = exchange_.lock()) exchange->abandon();
    }
    return std::nullopt;
  }
  const std::size_t taken = state_ == State::writing ? count_taken(now) : 0;
  if (now < deadline_) return std::nullopt;
  if (state_ == State::writing && taken >= written_ + write_slice) {
    written_ = taken;
    deadline_ = now + patience_.write;
    return std::nullopt;
  }
  if (state_ == State::reading || (state_ == State::waiting && fresh_)) return begin(too_slow());
  close();
  return std::nullopt;
}

void Connection::deliver(Outgoing outgoing, Clock::time_point now) {
  outgoing_ = std::move(outgoing);
  body_share_.reset();
  state_ = State::writing;
  answered_ = took_ = now;
  deadline_ = now + patience_.write;
  taken_ = 0;
  written_ = count_taken(now);
  write(now);
}

void Connection::write(Clock::time_point now) {
  switch (outgoing_.send(socket())) {
    case Outgoing::Progress::failed:
      close();
      return;
    case Outgoing::Progress::blocked:
      return;
    case Outgoing::Progress::done:
      break;
  }
  const auto follow = outgoing_.follow();
  outgoing_ = {};
  if (follow == Follow::keep_alive) {
    wait_for_next(now);
  } else if (refused_) {
    linger(now);
  } else {
    close();
  }
}

/// Bytes of the answer that have reached the client. What is sent may be megabytes that the kernel keeps, and
/// it takes more only when a third of that is gone.
std::size_t Connection::count_taken(Clock::time_point now) {
  int kept = 0;
  if (::ioctl(socket(), SIOCOUTQ, &kept) != 0 || kept < 0) kept = 0;
  const std::size_t taken = outgoing_.sent() - std::min(outgoing_.sent(), static_cast<std::size_t>(kept));
  if (taken > taken_) took_ = now;
  return taken_ = std::max(taken, taken_);
}

void Connection::wait_for_next(Clock::time_point now) {
  state_ = State::waiting;
  deadline_ = now + patience_.idle;
}

// The client may still be sending. Closing now would send a reset, which can overtake the answer.
void Connection::linger(Clock::time_point now) {
  state_ = State::lingering;
  deadline_ = now + patience_.linger;
  ::shutdown(socket(), SHUT_WR);
  discard();
}

void Connection::discard() {
  std::array<char, 16384> bytes;
  while (discarded_ < most_discarded) {
    const auto count = receive(socket(), bytes.data(), bytes.size(), 0);
    const auto receipt = receipt_of(count);
    if (receipt == Receipt::nothing_now) return;
    if (receipt == Receipt::end) break;
    discarded_ += static_cast<std::size_t>(count);
  }
  close();
}

void Connection::turn_away(Clock::time_point now) {
  refused_ = true;
  deliver(Outgoing::out_of_memory(), now);
}

void Connection::close() {
  socket_.reset();
  state_ = State::closed;
}

}  // namespace qdot::server
