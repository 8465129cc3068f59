#include <time.h>

#include <utility>

#include "server/lanes.hpp"
#include "server/running_task.hpp"

namespace qdot::server {
namespace {

constexpr double misjudged = 4;                    // times its cost: what takes longer is in the wrong lane
constexpr std::size_t most_turns_waited_for = 64;  // by threads that have begun something
constexpr auto between_looks = std::chrono::milliseconds(20);

Lane next(Lane lane) { return lane == Lane::light ? Lane::heavy : Lane::lengthy; }

}  // namespace

double seconds_since(Steady::time_point begun) {
  return std::chrono::duration<double>(Steady::now() - begun).count();
}

double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

RunningTask* RunningTask::place() {
  if (!turn) return this;
  return turn->state == LentTurn::State::taken ? turn->lent : nullptr;
}

void Lanes::count_help(double seconds) {
  if (RunningTask* const task = current_ == nullptr ? nullptr : current_->place()) task->had -= seconds;
}

bool Lanes::none_may_step_aside(const State& lane) const { return lane.aside >= threads_; }

void Lanes::make_room(const std::function<bool()>& given_up) {
  RunningTask* const task = current_ == nullptr ? nullptr : current_->place();
  if (task == nullptr || task->lane == Lane::lengthy || task->done) return;
  const State& it = state(task->lane);
  // A task asks often; a thread of low priority must not have the lock that often, which others wait for.
  const auto is_misjudged = [&](double seconds) {
    return seconds >= it.limits.longest_stay && 1000 * seconds > misjudged * task->cost;
  };
  const double at_most = seconds_since(task->begun);
  const bool stays = task->aside || none_may_step_aside(it);
  if (at_most < it.limits.longest_task || (stays && !is_misjudged(at_most))) return;
  const double took = processor_seconds() - task->had;
  if (took < it.limits.longest_task) return;
  if (is_misjudged(took) && change_lane(*current_, 1000 * took, given_up)) return;
  step_aside(*task);
}

void Lanes::step_aside(RunningTask& task) {
  State& it = state(task.lane);
  {
    const std::lock_guard lock(mutex_);
    if (task.aside || none_may_step_aside(it) || !add_worker(task.lane)) return;
    ++it.aside;
    it.give_place_back(task);
    task.aside = task.is_replaced = true;
  }
  it.changed.notify_one();
  lower_priority();
}

/// A turn in the next lane, to be waited for; null where the task has to go on where it is. Called with the
/// lock.
std::shared_ptr<LentTurn> Lanes::leave(RunningTask& task, double milliseconds) {
  RunningTask& place = *task.place();
  if (turns_waited_for_ >= most_turns_waited_for) return nullptr;
  if (!task.turn && !task.aside && !add_worker(task.lane)) return nullptr;
  const auto turn = std::make_shared<LentTurn>();
  enqueue(state(next(place.lane)), {.cost = milliseconds,
                                    .bytes = place.bytes,
                                    .task = [this, turn] { lend(*turn); },
                                    .lends_its_turn = true});
  State& it = state(place.lane);
  it.bytes -= std::exchange(place.bytes, 0);
  if (task.turn) {
    give_back(*task.turn);
  } else {
    it.running_cost -= task.cost;
    if (task.aside) --it.aside;
    it.give_place_back(task);
    --it.running;
    ++it.elsewhere;
    task.done = task.is_replaced = true;
  }
  it.changed.notify_all();
  return task.turn = turn;
}

void Lanes::give_back(LentTurn& turn) {
  turn.state = LentTurn::State::over;
  turn.changed.notify_all();
}

/// False where it has to go on where it is.
bool Lanes::change_lane(RunningTask& task, double milliseconds, const std::function<bool()>& given_up) {
  std::unique_lock lock(mutex_);
  const auto turn = leave(task, milliseconds);
  if (!turn) return false;
  const auto is_waited_for = [&] { return turn->state == LentTurn::State::waited_for; };
  ++turns_waited_for_;
  while (is_waited_for()) {
    turn->changed.wait_for(lock, between_looks);
    lock.unlock();
    const bool ends = given_up();
    lock.lock();
    if (ends && is_waited_for()) turn->state = LentTurn::State::given_up;
  }
  --turns_waited_for_;
  if (turn->lent != nullptr) turn->lent->had = processor_seconds();
  lock.unlock();
  lower_priority();
  return true;
}

/// By a thread of that lane.
void Lanes::lend(LentTurn& turn) {
  std::unique_lock lock(mutex_);
  if (turn.state != LentTurn::State::waited_for) return;
  turn.lent = current_;
  turn.state = LentTurn::State::taken;
  turn.changed.notify_all();
  turn.changed.wait(lock, [&] { return turn.state == LentTurn::State::over; });
}

}  // namespace qdot::server
