// Values made once for several threads. What is slow here waits for a latch that the test opens; a test that
// waited for the wrong thread would hang, and be ended by its time limit.

#include "core/base/made_once.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <stdexcept>
#include <string>
#include <thread>

#include "core/base/error.hpp"

namespace qdot {
namespace {

/// A thread that makes the value of one key and holds it back until it is told to go on.
class SlowMaker {
 public:
  SlowMaker(MadeOnce<std::string, int>& cache, const std::string& key, std::function<int()> result)
      : thread_([this, &cache, key, result] {
          try {
            value = cache.get(key, [&] {
              began_.count_down();
              go_on_.wait();
              return result();
            });
          } catch (...) {
            failed = true;
          }
        }) {
    began_.wait();
  }
  ~SlowMaker() { finish(); }

  void finish() {
    if (!thread_.joinable()) return;
    go_on_.count_down();
    thread_.join();
  }

  int value{};
  bool failed{};

 private:
  std::latch began_{1}, go_on_{1};
  std::thread thread_;
};

int one() { return 1; }
int two() { return 2; }

TEST(MadeOnce, MakesAValueOnceAndKeepsItWhereItIs) {
  MadeOnce<std::string, int> cache;
  const int& first = cache.get("a", one);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(&cache.get("a", two), &first);
  EXPECT_EQ(cache.get("b", two), 2);
}

TEST(MadeOnce, GivesAnotherKeyAtOnceWhileOneIsSlow) {
  MadeOnce<std::string, int> cache;
  SlowMaker slow(cache, "slow", one);
  EXPECT_EQ(cache.get("quick", two), 2);
  slow.finish();
  EXPECT_EQ(slow.value, 1);
}

TEST(MadeOnce, SharesTheWorkOfThreadsThatWantTheSameKey) {
  MadeOnce<std::string, int> cache;
  std::atomic<int> made{};
  SlowMaker slow(cache, "a", [&] { return ++made; });
  std::vector<std::thread> others;
  std::atomic<int> sum{};
  for (int i = 0; i < 4; ++i) {
    others.emplace_back([&] { sum += cache.get("a", [&] { return ++made; }); });
  }
  slow.finish();
  for (std::thread& thread : others) thread.join();
  EXPECT_EQ(made, 1);
  EXPECT_EQ(sum, 4);
}

TEST(MadeOnce, LetsTheNextOneInAfterAMakerThatThrows) {
  MadeOnce<std::string, int> cache;
  EXPECT_THROW((void)cache.get("a", []() -> int { throw Error(ErrorCode::too_large, "too large"); }), Error);
  EXPECT_EQ(cache.get("a", one), 1);
}

TEST(MadeOnce, LetsAWaitingThreadMakeWhatAnotherGaveUp) {
  MadeOnce<std::string, int> cache;
  SlowMaker slow(cache, "a", []() -> int { throw Interrupted{}; });
  int value{};
  std::thread waiting([&] { value = cache.get("a", two); });
  slow.finish();
  waiting.join();
  EXPECT_TRUE(slow.failed);
  EXPECT_EQ(value, 2);
}

TEST(MadeOnce, EndsTheWaitOfAThreadWhoseOwnAnswerIsNotAwaitedAnyMore) {
  MadeOnce<std::string, int> cache;
  SlowMaker slow(cache, "a", one);
  int polls{};
  const WorkScope scope(10, [&polls] { return ++polls == 3; });
  EXPECT_THROW((void)cache.get("a", two), Interrupted);
  EXPECT_EQ(polls, 3);
  slow.finish();
  EXPECT_EQ(cache.get("a", two), 1);
}

TEST(MadeOnce, AllowsAValueThatNeedsAnother) {
  MadeOnce<std::string, int> cache;
  EXPECT_EQ(cache.get("sum", [&] { return cache.get("a", one) + cache.get("b", two); }), 3);
}

}  // namespace
}  // namespace qdot
