#include "server/processors.hpp"

#include <sched.h>

#include <algorithm>
#include <thread>

namespace qdot::server {

int usable_processors() {
  cpu_set_t allowed;
  // Fails where the machine has more processors than the set has places.
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace qdot::server
