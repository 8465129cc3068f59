#include "server/poller.hpp"

#include <sys/eventfd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace qdot::server {
namespace {

constexpr Id wake_id = 0;

Descriptor checked(int descriptor) {
  if (descriptor < 0) throw std::runtime_error(std::strerror(errno));
  return Descriptor(descriptor);
}

}  // namespace

Poller::Poller()
    : epoll_(checked(::epoll_create1(EPOLL_CLOEXEC))),
      wake_(checked(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC))) {
  watch(wake_, wake_id, EPOLLIN);
}

void Poller::watch(const Descriptor& descriptor, Id id, std::uint32_t events) const {
  epoll_event event{.events = events, .data = {.u64 = id}};
  if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, descriptor.get(), &event) != 0)
    throw std::runtime_error(std::strerror(errno));
}

void Poller::forget(const Descriptor& descriptor) const {
  ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, descriptor.get(), nullptr);
}

std::span<const epoll_event> Poller::wait(int milliseconds) {
  const int count = ::epoll_wait(epoll_.get(), events_.data(), events_.size(), milliseconds);
  const auto begin = events_.begin(), end = begin + std::max(count, 0);
  const auto woken = std::find_if(begin, end, [](const epoll_event& e) { return e.data.u64 == wake_id; });
  if (woken == end) return {begin, end};
  std::uint64_t times = 0;
  [[maybe_unused]] const auto size = ::read(wake_.get(), &times, sizeof times);
  std::rotate(woken, woken + 1, end);
  return {begin, end - 1};
}

void Poller::wake() const {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

}  // namespace qdot::server
