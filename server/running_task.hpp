#pragma once
// A task of a lane while it runs, and the turn that it may be lent in another lane (lanes.hpp).

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>

#include "server/lane.hpp"

namespace qdot::server {

using Steady = std::chrono::steady_clock;

[[nodiscard]] double seconds_since(Steady::time_point begun);

/// That this thread has had.
[[nodiscard]] double processor_seconds();

struct LentTurn;

struct RunningTask {
  Lane lane;
  double cost;
  std::size_t bytes;
  bool tells_pace;
  std::size_t places;  // of its lane
  Steady::time_point begun{Steady::now()};
  double had{processor_seconds()};  // seconds of a processor, before it began
  bool aside{false};
  bool done{false};
  bool is_replaced{false};           // another thread does this one's work
  std::shared_ptr<LentTurn> turn{};  // in another lane, once it has changed

  /// Where it runs now; null where it does not.
  [[nodiscard]] RunningTask* place();
};

/// In a lane, for a task that has begun in another one. The lane's thread lends its own, and waits while the
/// task's thread uses it.
struct LentTurn {
  enum class State { waited_for, taken, over, given_up };
  State state{State::waited_for};
  RunningTask* lent{};
  std::condition_variable changed{};
};

}  // namespace qdot::server
