#pragma once
// epoll, by which one thread waits for all sockets at once, and a way for other threads to wake it.

#include <sys/epoll.h>

#include <array>
#include <cstdint>
#include <span>

#include "server/descriptor.hpp"

namespace qdot::server {

using Id = std::uint64_t;

class Poller {
 public:
  /// Throws std::runtime_error where the system has no descriptor for it. Nobody else uses the Id 0.
  Poller();

  /// wait() names what happens to the descriptor by `id`. Throws std::runtime_error where there is no memory.
  void watch(const Descriptor& descriptor, Id id, std::uint32_t events) const;
  void forget(const Descriptor& descriptor) const;

  /// What has happened; `milliseconds` -1 waits for ever. To be woken is no event.
  [[nodiscard]] std::span<const epoll_event> wait(int milliseconds);

  /// From any thread.
  void wake() const;

 private:
  Descriptor epoll_, wake_;
  std::array<epoll_event, 256> events_{};
};

}  // namespace qdot::server
