#include "server/processors.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

namespace qdot::server {
namespace {

int allowed_processors() {
  cpu_set_t allowed;
  // Fails where the machine has more processors than the set has places.
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) return CPU_COUNT(&allowed);
  return static_cast<int>(std::thread::hardware_concurrency());
}

}  // namespace

int usable_processors(const std::string& quota) {
  const int allowed = std::max(1, allowed_processors());
  std::ifstream file(quota);
  double microseconds = 0, period = 0;
  if (!(file >> microseconds >> period) || !(microseconds > 0 && period > 0)) return allowed;
  return static_cast<int>(std::clamp(std::ceil(microseconds / period), 1.0, static_cast<double>(allowed)));
}

}  // namespace qdot::server
