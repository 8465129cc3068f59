#include "server/lanes.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "server/running_task.hpp"

namespace qdot::server {
namespace {

constexpr double assumed_pace = 1e-3;  // seconds that a unit of cost takes, before anything was measured
constexpr double assumed_cost = 20;    // how much measured work this assumption weighs as much as
constexpr double memory = 0.95;        // the weight that the past keeps after each piece of work

}  // namespace

thread_local RunningTask* Lanes::current_ = nullptr;

double Lanes::State::expected_wait(std::size_t threads) const {
  return (waiting_cost + running_cost) / static_cast<double>(threads) * (recent_seconds / recent_cost);
}

double Lanes::State::time_of(const Work& work, std::size_t threads) const {
  return work.cost / (work.spreads ? static_cast<double>(threads) : 1) * (recent_seconds / recent_cost);
}

void Lanes::State::give_place_back(RunningTask& task) {
  if (task.places > 1) changed.notify_all();  // its own thread takes one of them
  places -= std::exchange(task.places, 0);
}

double Lanes::State::longest_wait(Steady::time_point now) const {
  const std::chrono::duration<double> busy = now - idle;
  return std::max(limits.burst_wait - busy.count(), limits.longest_wait);
}

Lanes::Lanes(const LanesOptions& options) : threads_(static_cast<std::size_t>(std::max(options.threads, 1))) {
  state(Lane::light).limits = options.light;
  state(Lane::heavy).limits = options.heavy;
  state(Lane::lengthy).limits = options.lengthy;
  for (State& lane : states_) {
    lane.recent_cost = assumed_cost;
    lane.recent_seconds = assumed_cost * assumed_pace;
  }
  for (const Lane lane : all_lanes) {
    for (std::size_t i = 0; i < threads_; ++i) workers_.emplace_back([this, lane] { work(lane); });
  }
}

Lanes::~Lanes() {
  wait_until_idle();  // from then on nothing changes lanes
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  for (State& lane : states_) lane.changed.notify_all();
}

bool Lanes::submit(Lane lane, Work work) {
  State& it = state(lane);
  const std::lock_guard lock(mutex_);
  if (!has_room(it, work)) return false;
  enqueue(it, std::move(work));
  return true;
}

bool Lanes::has_room(const State& lane, const Work& work) const {
  if (lane.queue.empty() && is_free(lane)) return true;
  const double wait = lane.expected_wait(threads_);
  return lane.queue.size() < lane.limits.waiting && wait <= lane.longest_wait(Steady::now()) &&
         wait + lane.time_of(work, threads_) <= lane.limits.done_within;
}

void Lanes::enqueue(State& lane, Work work) {
  if (lane.queue.empty() && is_free(lane)) lane.idle = Steady::now();
  lane.waiting_cost += work.cost;
  lane.queue.push_back(std::move(work));
  lane.changed.notify_one();
}

// If nothing of a lane runs, something may always begin: the bound on memory must not stop the only task that
// asks for it.
bool Lanes::next_may_begin(const State& lane) const {
  if (lane.queue.empty() || !is_free(lane)) return false;
  const std::size_t wanted = lane.queue.front().bytes;
  return wanted == 0 || lane.bytes == 0 || lane.bytes + wanted <= lane.limits.bytes;
}

/// False where no thread can be had.
bool Lanes::add_worker(Lane lane) {
  if (Steady::now() < no_thread_until_) return false;
  retired_.clear();
  try {
    workers_.emplace_back([this, lane] { work(lane); });
    return true;
  } catch (const std::exception&) {
    no_thread_until_ = Steady::now() + std::chrono::milliseconds(100);
    return false;
  }
}

void Lanes::work(Lane lane) {
  if (lane != Lane::light) lower_priority();
  State& it = state(lane);
  std::unique_lock lock(mutex_);
  for (;;) {
    it.changed.wait(lock, [&] { return next_may_begin(it) || (closed_ && it.queue.empty()); });
    if (it.queue.empty()) {
      it.changed.notify_all();  // the other threads wait for this queue to be empty, too
      return;
    }
    const bool goes_on = begin(lane, lock);
    if (it.is_idle()) idle_.notify_all();
    if (!goes_on) return retire();
  }
}

/// Another thread is there instead of this one.
void Lanes::retire() {
  const auto self = std::ranges::find(workers_, std::this_thread::get_id(), &std::jthread::get_id);
  retired_.splice(retired_.end(), workers_, self);
}

/// False where another thread has taken this one's place.
bool Lanes::begin(Lane lane, std::unique_lock<std::mutex>& lock) {
  State& it = state(lane);
  Work work = std::move(it.queue.front());
  it.queue.pop_front();
  it.waiting_cost = it.queue.empty() ? 0 : it.waiting_cost - work.cost;
  it.running_cost += work.cost;
  ++it.running;
  it.bytes += work.bytes;
  const std::size_t places = work.spreads ? threads_ - it.places : 1;
  it.places += places;
  lock.unlock();
  RunningTask running{.lane = lane,
                      .cost = work.cost,
                      .bytes = work.bytes,
                      .tells_pace = !work.lends_its_turn,
                      .places = places};
  current_ = &running;
  work.task();
  work.task = nullptr;  // gives back what it held before the next one begins
  current_ = nullptr;
  lock.lock();
  end(running);
  return !running.is_replaced;
}

void Lanes::end(RunningTask& task) {
  State& it = state(task.lane);
  if (task.turn) {
    --it.elsewhere;
    return give_back(*task.turn);
  }
  it.bytes -= task.bytes;
  count_done(task, Outcome::computed);
  if (task.aside) --it.aside;
  if (--it.running == 0) it.running_cost = 0;
  if (task.bytes > 0) it.changed.notify_all();  // there is memory for others now
}

void Lanes::count_done(RunningTask& task, Outcome outcome) {
  if (std::exchange(task.done, true)) return;
  State& it = state(task.lane);
  it.running_cost -= task.cost;
  if (task.aside) return;  // its time says nothing about the pace of the others
  const double took = seconds_since(task.begun) * static_cast<double>(task.places);
  it.give_place_back(task);
  const bool is_part = outcome == Outcome::given_up && took * it.recent_cost < task.cost * it.recent_seconds;
  if (!task.tells_pace || is_part) return;
  it.recent_seconds = memory * it.recent_seconds + took;
  it.recent_cost = memory * it.recent_cost + task.cost;
}

void Lanes::make_way(Outcome outcome) {
  if (current_ == nullptr) return;
  const std::lock_guard lock(mutex_);
  if (RunningTask* const task = current_->place()) count_done(*task, outcome);
}

void Lanes::wait_until_idle() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] {
    for (const State& lane : states_) {
      if (!lane.is_idle()) return false;
    }
    return true;
  });
}

Lanes::Gauges Lanes::gauges(Lane lane) const {
  const std::lock_guard lock(mutex_);
  const State& it = state(lane);
  return {.waiting = it.queue.size(), .running = it.running};
}

}  // namespace qdot::server
