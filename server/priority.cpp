#include "server/priority.hpp"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace qdot::server {
namespace {

constexpr int heavy_niceness = 10;
/// The kernel's sched_attr, whose header cannot stand beside the C library's.
struct SchedulingAttributes {
  std::uint32_t size{sizeof(SchedulingAttributes)};
  std::uint32_t policy{};  ///< the usual one
  std::uint64_t flags{};
  std::int32_t niceness{};
  std::uint32_t priority{};
  std::uint64_t slice{100'000};  ///< nanoseconds, the least
  std::uint64_t deadline{}, period{};
};

}  // namespace

// On Linux each thread has its own niceness.
void give_way() { (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), heavy_niceness); }

void wake_at_once() {
  SchedulingAttributes attributes;
  attributes.niceness = ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
  (void)::syscall(SYS_sched_setattr, 0, &attributes, 0U);
}

}  // namespace qdot::server
