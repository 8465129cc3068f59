#pragma once
// Decides who computes and who waits. There are three lanes, for light, heavy and lengthy work, each with its
// own threads, its own bounded queue and its own bound on memory. So what takes a tenth of a second never
// waits for what takes many: where several lanes have work, the operating system shares the cores among their
// threads. Those of light work go first; heavy and lengthy ones have a lower priority, the same for both, so
// that neither starves the other. Lanes are ours because httplib has one queue, without bound and without
// priorities.
//
// Within a lane work begins in the order of its coming, as many at a time as there are threads. Running all
// that comes at once would be fair, too, but then a burst would fail as a whole at its deadline.
//
// A queue is bounded by the time until its last entry would begin: the sum of the costs ahead of it, divided
// by the threads, times the seconds that a unit of cost takes. Each request tells its cost; only the pace is
// measured.
//
// Work that spreads over all threads takes all places of its lane that are free: several beside each other
// would all be done late.
//
// A cost is only thought, and may be wrong a hundredfold. What has taken far longer than it was thought to
// take waits in the next lane's queue like any other work there, in the middle of what it does (as in the
// multilevel feedback queues of operating systems). Beside what has only taken longer than others of its lane
// should wait for, another one begins.
//
// A burst is no overload: what comes all at once to a lane that was idle may wait longer, because nothing
// need follow it. It may wait as long as the lane can be done with all of it in a given time after it was
// idle. So an offer that does not end fills that time once, and not again while it passes: from then on the
// bound is the narrow one, until the lane has been idle once more (as routers tell a good queue from a
// standing one: Nichols and Jacobson, Controlling queue delay, ACM Queue 10 (2012)).

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <list>
#include <memory>
#include <mutex>
#include <thread>

#include "server/lane.hpp"

namespace qdot::server {

struct LaneLimits {
  double longest_wait{};  ///< seconds that the last entry of the queue may expect to wait
  double burst_wait{};    ///< or it may begin within this many seconds after the lane was idle
  double done_within{std::numeric_limits<double>::infinity()};  ///< seconds that wait and work may come to
  std::size_t waiting{};                                        ///< entries that the queue may have
  std::size_t bytes{std::size_t{64} << 20};                     ///< that its work may hold at a time
  double longest_task{};  ///< seconds of a processor, after which a task makes room for others
  double longest_stay{};  ///< and after which one that was misjudged belongs into the next lane
};

struct LanesOptions {
  int threads{
      1};  ///< of each lane; what steps aside or changes lanes keeps its thread, and another takes its place
  LaneLimits light{
      .longest_wait = 0.1, .burst_wait = 0.5, .waiting = 1024, .longest_task = 0.05, .longest_stay = 0.05};
  LaneLimits heavy{.longest_wait = 1,
                   .burst_wait = 5,
                   .waiting = 1024,
                   .bytes = std::size_t{32} << 20,
                   .longest_task = 0.25,
                   .longest_stay = 1.5};
  LaneLimits lengthy{.longest_wait = 5, .burst_wait = 5, .waiting = 1024};
};

struct RunningTask;
struct LentTurn;

class Lanes {
 public:
  using Task = std::function<void()>;
  struct Work {
    double cost{1};              ///< in milliseconds, roughly
    std::size_t bytes{0};        ///< bytes that it will hold
    Task task;                   ///< must not throw
    bool spreads{false};         ///< over as many threads as the lane has
    bool lends_its_turn{false};  ///< to a task that has begun in another lane: its time tells no pace
  };

  explicit Lanes(const LanesOptions& options);
  /// Finishes what was admitted.
  ~Lanes();
  Lanes(const Lanes&) = delete;
  Lanes& operator=(const Lanes&) = delete;

  /// False when the lane is full; never waits.
  [[nodiscard]] bool submit(Lane lane, Work work);

  /// A task calls this now and then. If it has run too long for its lane, and far longer than its cost, this
  /// waits until its turn in the next lane has come, or until it is given up. If it has only run too long,
  /// another may run beside it from now on: at most `threads` tasks of a lane step aside at a time, and of
  /// the lengthy lane none.
  void make_room(const std::function<bool()>& given_up);

  /// What other threads have computed for the task of this one, in seconds of a processor, counts as its own.
  static void count_help(double seconds);

  /// A task calls this just before its answer goes out: nothing waits for it any more. Its client's next
  /// request may come before this thread runs again. What was given up tells no pace.
  enum class Outcome { computed, given_up };
  void make_way(Outcome outcome = Outcome::computed);

  /// Returns when nothing runs and nothing waits.
  void wait_until_idle();

  struct Gauges {
    std::size_t waiting{};
    std::size_t running{};
  };
  [[nodiscard]] Gauges gauges(Lane lane) const;

 private:
  struct State {
    LaneLimits limits;
    std::deque<Work> queue;
    std::condition_variable changed;
    std::size_t running{0};
    std::size_t places{0};              // that others wait for, taken by what runs
    std::atomic<std::size_t> aside{0};  // tasks that have stepped aside
    std::size_t elsewhere{0};           // tasks that have changed to another lane, and their threads
    std::size_t bytes{0};               // held by what runs
    double running_cost{0}, waiting_cost{0};
    std::chrono::steady_clock::time_point idle{};  // when the lane last had a thread that did nothing
    // Recent work, older work counting less: the pace is their quotient.
    double recent_seconds{0}, recent_cost{0};
    [[nodiscard]] bool is_idle() const { return queue.empty() && running == 0 && elsewhere == 0; }
    [[nodiscard]] double expected_wait(std::size_t threads) const;
    [[nodiscard]] double time_of(const Work& work, std::size_t threads) const;
    void give_place_back(RunningTask& task);
    [[nodiscard]] double longest_wait(std::chrono::steady_clock::time_point now) const;
  };

  [[nodiscard]] bool add_worker(Lane lane);
  void work(Lane lane);
  void retire();
  [[nodiscard]] bool begin(Lane lane, std::unique_lock<std::mutex>& lock);
  void end(RunningTask& task);
  void enqueue(State& lane, Work work);
  void count_done(RunningTask& task, Outcome outcome);
  [[nodiscard]] bool none_may_step_aside(const State& lane) const;
  void step_aside(RunningTask& task);
  [[nodiscard]] std::shared_ptr<LentTurn> leave(RunningTask& task, double milliseconds);
  [[nodiscard]] bool change_lane(RunningTask& task, double milliseconds,
                                 const std::function<bool()>& given_up);
  void lend(LentTurn& turn);
  static void give_back(LentTurn& turn);
  [[nodiscard]] bool has_room(const State& lane, const Work& work) const;
  [[nodiscard]] bool is_free(const State& lane) const { return lane.places < threads_; }
  [[nodiscard]] bool next_may_begin(const State& lane) const;
  State& state(Lane lane) { return states_[static_cast<std::size_t>(lane)]; }
  [[nodiscard]] const State& state(Lane lane) const { return states_[static_cast<std::size_t>(lane)]; }

  static thread_local RunningTask* current_;  // the task of this thread, as it began
  const std::size_t threads_;
  mutable std::mutex mutex_;
  std::array<State, all_lanes.size()> states_;
  std::condition_variable idle_;
  bool closed_{false};
  std::chrono::steady_clock::time_point no_thread_until_{};  // then it is tried again whether one can be had
  std::size_t turns_waited_for_{0};
  std::list<std::jthread> retired_, workers_;
};

}  // namespace qdot::server
