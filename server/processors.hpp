#pragma once
// How many processors the server may use, from which it decides how many threads compute. In a container that
// is less than the machine has.

#include <string>

namespace qdot::server {

/// Where Linux says how much of the processors a container may use (cgroup v2): "50000 100000" is half of
/// one, "max 100000" all there are.
inline constexpr const char* quota_file = "/sys/fs/cgroup/cpu.max";

/// The processors that this process may run on, and no more than its quota, rounded up; one at least.
/// std::thread::hardware_concurrency() counts the machine's: on fewer, threads that compute take turns, and
/// the thread that answers light requests waits until one turn ends.
[[nodiscard]] int usable_processors(const std::string& quota = quota_file);

}  // namespace qdot::server
