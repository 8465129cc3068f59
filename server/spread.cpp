#include "server/spread.hpp"

#include <pthread.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "server/lane.hpp"

namespace qdot::server {
namespace {

constexpr auto between_calls = std::chrono::milliseconds(20);

/// Threads that do the same beside the one that asks.
class Helpers {
 public:
  /// Where no thread can be had, those that are there do the work.
  Helpers(std::size_t count, const std::function<void()>& work) {
    try {
      for (std::size_t i = 0; i < count; ++i) {
        threads_.emplace_back([this, &work] {
          work();
          end();
        });
        const std::lock_guard lock(mutex_);
        ++begun_;
      }
    } catch (const std::system_error&) {
      return;
    }
  }

  void wait(const std::function<void(double helped)>& meanwhile) {
    double before = 0;
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, between_calls, [this] { return ended_ == begun_; })) {
      lock.unlock();
      const double now = processor_seconds();
      meanwhile(std::max(now - std::exchange(before, now), 0.0));
      lock.lock();
    }
  }

 private:
  void end() {
    const std::lock_guard lock(mutex_);
    ++ended_;
    changed_.notify_one();
  }

  /// Of those that still run.
  double processor_seconds() {
    double sum = 0;
    for (std::jthread& thread : threads_) {
      clockid_t clock{};
      timespec had{};
      if (::pthread_getcpuclockid(thread.native_handle(), &clock) == 0 && ::clock_gettime(clock, &had) == 0)
        sum += static_cast<double>(had.tv_sec) + 1e-9 * static_cast<double>(had.tv_nsec);
    }
    return sum;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t begun_{0}, ended_{0};
  std::vector<std::jthread> threads_;
};

}  // namespace

api::Spread spread_over(int threads, Help help, std::function<void(double helped)> waits) {
  return [threads, help, waits = std::move(waits)](std::size_t count, const api::SpreadTask& task) {
    std::atomic<std::size_t> next{0};
    const auto take_tasks = [&] {
      std::size_t i = next++;
      while (i < count && task(i)) i = next++;
    };
    const std::function<void()> help_out = [&] {
      if (help == Help::beside_light_work) lower_priority();
      take_tasks();
    };
    const std::size_t wanted = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
    Helpers helpers(wanted > 0 ? wanted - 1 : 0, help_out);
    take_tasks();
    helpers.wait(waits);
  };
}

}  // namespace qdot::server
