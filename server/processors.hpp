#pragma once

namespace qdot::server {

/// The processors that this process may run on, one at least. std::thread::hardware_concurrency() counts the
/// machine's: on fewer, threads that compute take turns, and who answers light requests waits for one turn to
/// end.
[[nodiscard]] int usable_processors();

}  // namespace qdot::server
