#include "server/lanes.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace qdot::server {
namespace {

constexpr double assumed_pace = 1e-3;  // seconds that a unit of cost takes, before anything was measured
constexpr double assumed_cost = 20;    // how much measured work this assumption weighs as much as
constexpr double memory = 0.95;        // the weight that the past keeps after each piece of work

}  // namespace

struct Lanes::Running {
  Lane lane;
  double cost;
  std::chrono::steady_clock::time_point begun{std::chrono::steady_clock::now()};
  bool aside{false};
  bool done{false};
};

thread_local Lanes::Running* Lanes::current_ = nullptr;

double Lanes::State::expected_wait(int threads) const {
  return (waiting_cost + running_cost) / threads * (recent_seconds / recent_cost);
}

double Lanes::State::longest_wait(std::chrono::steady_clock::time_point now) const {
  const std::chrono::duration<double> busy = now - idle;
  return std::max(limits.burst_wait - busy.count(), limits.longest_wait);
}

Lanes::Lanes(const LanesOptions& options) : threads_(options.threads) {
  state(Lane::light).limits = options.light;
  state(Lane::heavy).limits = options.heavy;
  state(Lane::lengthy).limits = options.lengthy;
  for (State& lane : states_) {
    lane.recent_cost = assumed_cost;
    lane.recent_seconds = assumed_cost * assumed_pace;
  }
  for (const Lane lane : all_lanes) {
    // Where tasks may step aside there are spare threads, for those that then begin beside them.
    const int count = lane == Lane::lengthy ? threads_ : 2 * threads_;
    for (int i = 0; i < count; ++i) workers_.emplace_back([this, lane] { work(lane); });
  }
}

Lanes::~Lanes() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  for (State& lane : states_) lane.changed.notify_all();
}

bool Lanes::submit(Lane lane, Work work) {
  State& it = state(lane);
  {
    const std::lock_guard lock(mutex_);
    const bool free = it.queue.empty() && it.running - it.aside < static_cast<std::size_t>(threads_);
    const auto now = std::chrono::steady_clock::now();
    if (free) it.idle = now;
    if (!free &&
        (it.queue.size() >= it.limits.waiting || it.expected_wait(threads_) > it.longest_wait(now))) {
      return false;
    }
    it.waiting_cost += work.cost;
    it.queue.push_back(std::move(work));
  }
  it.changed.notify_one();
  return true;
}

// If nothing of a lane runs, something may always begin: the bound on memory must not stop the only task that
// asks for it.
bool Lanes::next_may_begin(Lane lane) const {
  const State& it = state(lane);
  if (it.queue.empty() || it.running - it.aside >= static_cast<std::size_t>(threads_)) return false;
  const std::size_t wanted = it.queue.front().bytes;
  return wanted == 0 || it.bytes == 0 || it.bytes + wanted <= it.limits.bytes;
}

void Lanes::work(Lane lane) {
  // On Linux each thread has its own niceness.
  if (lane != Lane::light) ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), heavy_niceness);
  State& it = state(lane);
  std::unique_lock lock(mutex_);
  for (;;) {
    it.changed.wait(lock, [&] { return next_may_begin(lane) || (closed_ && it.queue.empty()); });
    if (it.queue.empty()) {
      it.changed.notify_all();  // the other threads wait for this queue to be empty, too
      return;
    }
    begin(lane, lock);
    if (it.queue.empty() && it.running == 0) idle_.notify_all();
  }
}

void Lanes::begin(Lane lane, std::unique_lock<std::mutex>& lock) {
  State& it = state(lane);
  Work work = std::move(it.queue.front());
  it.queue.pop_front();
  it.waiting_cost = it.queue.empty() ? 0 : it.waiting_cost - work.cost;
  it.running_cost += work.cost;
  ++it.running;
  it.bytes += work.bytes;
  lock.unlock();
  Running running{.lane = lane, .cost = work.cost};
  current_ = &running;
  work.task();
  work.task = nullptr;  // gives back what it held before the next one begins
  current_ = nullptr;
  lock.lock();
  it.bytes -= work.bytes;
  count_done(running);
  --it.aside;
  if (--it.running == 0) it.running_cost = 0;
  if (work.bytes > 0) it.changed.notify_all();  // there is memory for others now
}

void Lanes::count_done(Running& task) {
  if (std::exchange(task.done, true)) return;
  State& it = state(task.lane);
  it.running_cost -= task.cost;
  if (task.aside) return;  // its time says nothing about the pace of the others
  ++it.aside;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - task.begun;
  it.recent_seconds = memory * it.recent_seconds + took.count();
  it.recent_cost = memory * it.recent_cost + task.cost;
}

void Lanes::make_way() {
  if (current_ == nullptr) return;
  const std::lock_guard lock(mutex_);
  count_done(*current_);
}

void Lanes::step_aside() {
  if (current_ == nullptr || current_->lane == Lane::lengthy || current_->aside || current_->done) return;
  State& it = state(current_->lane);
  const auto none_may = [&] { return it.aside >= static_cast<std::size_t>(threads_); };
  // A task asks often; a thread of low priority must not have the lock that often, which others wait for.
  if (none_may()) return;
  {
    const std::lock_guard lock(mutex_);
    if (none_may()) return;
    ++it.aside;
    current_->aside = true;
  }
  it.changed.notify_one();
}

void Lanes::wait_until_idle() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] {
    for (const State& lane : states_) {
      if (!lane.queue.empty() || lane.running > 0) return false;
    }
    return true;
  });
}

Lanes::Gauges Lanes::gauges(Lane lane) const {
  const std::lock_guard lock(mutex_);
  return {.waiting = state(lane).queue.size(), .running = state(lane).running};
}

}  // namespace qdot::server
