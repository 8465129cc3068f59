#include "server/lanes.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <functional>
#include <latch>
#include <memory>
#include <mutex>
#include <semaphore>
#include <thread>
#include <utility>
#include <vector>

namespace qdot::server {
namespace {

using namespace std::chrono_literals;

/// Occupies one thread of a lane until it is released.
class Occupied {
 public:
  Occupied(Lanes& lanes, Lane lane, std::size_t bytes = 0) {
    EXPECT_TRUE(lanes.submit(lane, {.bytes = bytes, .task = [latches = latches_] {
                                      latches->begun.count_down();
                                      latches->released.wait();
                                    }}));
  }
  void wait_until_begun() { latches_->begun.wait(); }
  bool has_begun() const { return latches_->begun.try_wait(); }
  void release() { latches_->released.count_down(); }

 private:
  struct Latches {
    std::latch begun{1};
    std::latch released{1};
  };
  std::shared_ptr<Latches> latches_ = std::make_shared<Latches>();
};

TEST(Lanes, WhatWasAdmittedIsDoneInOrder) {
  std::vector<int> done;
  {
    Lanes lanes({.threads = 1, .light = {.longest_wait = 1e9, .waiting = 100}});
    for (int i = 0; i < 50; ++i)
      EXPECT_TRUE(lanes.submit(Lane::light, {.task = [&done, i] { done.push_back(i); }}));
  }
  ASSERT_EQ(done.size(), 50u);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

TEST(Lanes, AFullLaneTurnsAwayAndTheOtherDoesNot) {
  Lanes lanes({.threads = 1, .light = {.longest_wait = 1e9, .waiting = 2}});
  Occupied first(lanes, Lane::light);
  first.wait_until_begun();
  EXPECT_TRUE(lanes.submit(Lane::light, {.task = [] {}}));
  EXPECT_TRUE(lanes.submit(Lane::light, {.task = [] {}}));
  EXPECT_FALSE(lanes.submit(Lane::light, {.task = [] {}}));
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.task = [] {}}));
  first.release();
  lanes.wait_until_idle();
  EXPECT_TRUE(lanes.submit(Lane::light, {.task = [] {}}));
}

TEST(Lanes, AQueueIsAsLongAsItsWaitAndNotAsItsEntries) {
  Lanes lanes({.threads = 1, .light = {.longest_wait = 0.1, .waiting = 1000}});
  Occupied first(lanes, Lane::light);
  first.wait_until_begun();
  // Nothing was measured yet: a unit of cost counts as a millisecond.
  EXPECT_TRUE(lanes.submit(Lane::light, {.cost = 60, .task = [] {}}));
  EXPECT_TRUE(lanes.submit(Lane::light, {.cost = 60, .task = [] {}}));
  EXPECT_FALSE(lanes.submit(Lane::light, {.cost = 1, .task = [] {}}));
  first.release();
}

TEST(Lanes, ABurstIsNoOverload) {
  Lanes lanes({.threads = 1, .heavy = {.longest_wait = 0.1, .burst_wait = 10, .waiting = 1000}});
  Occupied first(lanes, Lane::heavy);
  first.wait_until_begun();
  // Nothing was measured yet: a unit of cost counts as a millisecond.
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 100, .task = [] {}})) << i;
  EXPECT_FALSE(lanes.submit(Lane::heavy, {.cost = 100, .task = [] {}})) << "more than the burst may wait";
  first.release();
}

TEST(Lanes, WhatIsOfferedWithoutEndIsAnOverload) {
  Lanes lanes({.threads = 1, .heavy = {.longest_wait = 0.05, .burst_wait = 0.2, .waiting = 1000}});
  Occupied first(lanes, Lane::heavy);
  first.wait_until_begun();
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 70, .task = [] {}}));
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 1, .task = [] {}})) << "behind 70 ms, in a burst";
  std::this_thread::sleep_for(300ms);
  EXPECT_FALSE(lanes.submit(Lane::heavy, {.cost = 1, .task = [] {}})) << "the lane was busy all the time";
  first.release();
  lanes.wait_until_idle();
  Occupied next(lanes, Lane::heavy);
  next.wait_until_begun();
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 1, .task = [] {}})) << "it was idle since";
  next.release();
}

TEST(Lanes, ABurstIsDoneInItsTimeAndNothingJoinsItWhileThatPasses) {
  Lanes lanes({.threads = 1, .heavy = {.longest_wait = 0.05, .burst_wait = 0.6, .waiting = 1000}});
  Occupied first(lanes, Lane::heavy);
  first.wait_until_begun();
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 400, .task = [] {}}));
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 1, .task = [] {}})) << "behind 400 ms, at once";
  std::this_thread::sleep_for(300ms);
  EXPECT_FALSE(lanes.submit(Lane::heavy, {.cost = 1, .task = [] {}}))
      << "0.3 and 0.4 are more than 0.6 seconds";
  first.release();
}

TEST(Lanes, TheCostliestIsAdmittedWhereNobodyWaits) {
  Lanes lanes({.threads = 1, .heavy = {.longest_wait = 0, .waiting = 0}});
  std::latch done{1};
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 1e12, .task = [&] { done.count_down(); }}));
  done.wait();
}

TEST(Lanes, ThePaceIsMeasured) {
  Lanes lanes({.threads = 1, .light = {.longest_wait = 0.1, .waiting = 1000}});
  // Ten times slower than assumed: after a while ten times less may wait.
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(lanes.submit(Lane::light, {.cost = 1, .task = [] { std::this_thread::sleep_for(10ms); }}));
    lanes.wait_until_idle();
  }
  Occupied first(lanes, Lane::light);
  first.wait_until_begun();
  int admitted = 0;
  while (admitted < 100 && lanes.submit(Lane::light, {.cost = 1, .task = [] {}})) ++admitted;
  EXPECT_GE(admitted, 1);
  EXPECT_LT(admitted, 30);
  first.release();
}

TEST(Lanes, HeavyWorkHoldsBoundedMemory) {
  Lanes lanes({.threads = 2, .heavy = {.longest_wait = 1, .waiting = 9, .bytes = 100}});
  Occupied first(lanes, Lane::heavy, 80);
  first.wait_until_begun();
  Occupied second(lanes, Lane::heavy, 80);
  std::this_thread::sleep_for(20ms);
  EXPECT_FALSE(second.has_begun());
  Occupied light(lanes, Lane::light);
  light.wait_until_begun();
  Occupied lengthy(lanes, Lane::lengthy, 80);
  lengthy.wait_until_begun();
  lengthy.release();
  first.release();
  second.wait_until_begun();
  second.release();
  light.release();
}

TEST(Lanes, WhatIsAboutToAnswerKeepsNobodyOut) {
  Lanes lanes({.threads = 1, .heavy = {.longest_wait = 0, .waiting = 0}});
  std::latch answering{1};
  std::latch released{1};
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 1000, .task = [&] {
                                           lanes.make_way();
                                           answering.count_down();
                                           released.wait();
                                         }}));
  answering.wait();
  std::atomic<bool> next_began{false};
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 1000, .task = [&] { next_began = true; }}));
  EXPECT_FALSE(lanes.submit(Lane::heavy, {.cost = 1000, .task = [] {}})) << "one waits already";
  released.count_down();
  lanes.wait_until_idle();
  EXPECT_TRUE(next_began);
  EXPECT_EQ(lanes.gauges(Lane::heavy).running, 0u);
}

TEST(Lanes, NoLaneWaitsForAnother) {
  Lanes lanes({.threads = 2});
  std::vector<Occupied> occupied;
  for (const Lane lane : {Lane::lengthy, Lane::heavy, Lane::light}) {
    for (int i = 0; i < 2; ++i) occupied.emplace_back(lanes, lane).wait_until_begun();
  }
  EXPECT_EQ(lanes.gauges(Lane::lengthy).running, 2u);
  for (Occupied& one : occupied) one.release();
}

TEST(Lanes, LengthyWorkTakesTurnsSoThatABurstOfItDoesNotFailAsAWhole) {
  Lanes lanes({.threads = 1});
  const auto occupy = [&] { return Occupied(lanes, Lane::lengthy); };
  Occupied first = occupy();
  first.wait_until_begun();
  std::latch tried{1};
  Occupied second = occupy();
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.task = [&] { tried.count_down(); }}));
  tried.wait();
  EXPECT_FALSE(second.has_begun());
  first.release();
  second.wait_until_begun();
  second.release();
}

constexpr LaneLimits patient{.longest_wait = 1e9, .waiting = 100};
constexpr LaneLimits hasty{.longest_wait = 1e9, .waiting = 100, .longest_task = 0};
constexpr double as_thought = 1e9;  // so costly that it does not take longer

bool never() { return false; }

TEST(Lanes, WhatSpreadsTakesAllPlacesThatAreFree) {
  Lanes lanes({.threads = 2});
  std::latch begun{1}, released{1};
  EXPECT_TRUE(lanes.submit(Lane::lengthy, {.task =
                                               [&] {
                                                 begun.count_down();
                                                 released.wait();
                                               },
                                           .spreads = true}));
  begun.wait();
  Occupied second(lanes, Lane::lengthy);
  Occupied third(lanes, Lane::lengthy);
  std::this_thread::sleep_for(20ms);
  EXPECT_FALSE(second.has_begun());
  released.count_down();
  second.wait_until_begun();
  third.wait_until_begun();
  third.release();
  std::latch beside{1};
  EXPECT_TRUE(lanes.submit(Lane::lengthy, {.task = [&] { beside.count_down(); }, .spreads = true}));
  beside.wait();  // in the place that was free
  second.release();
  lanes.wait_until_idle();
  std::vector<Occupied> both;
  for (int i = 0; i < 2; ++i) both.emplace_back(lanes, Lane::lengthy).wait_until_begun();
  for (Occupied& one : both) one.release();
}

TEST(Lanes, WhatCouldNotBeDoneInTimeIsTurnedAway) {
  Lanes lanes({.threads = 1, .heavy = {.longest_wait = 1e9, .done_within = 1, .waiting = 100}});
  Occupied first(lanes, Lane::heavy);
  first.wait_until_begun();
  // Nothing was measured yet: a unit of cost counts as a millisecond.
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 500, .task = [] {}}));
  EXPECT_FALSE(lanes.submit(Lane::heavy, {.cost = 500, .task = [] {}})) << "behind 501 ms";
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 400, .task = [] {}}));
  first.release();
}

class WhereTasksMayStepAside : public testing::TestWithParam<Lane> {};
INSTANTIATE_TEST_SUITE_P(Lanes, WhereTasksMayStepAside, testing::Values(Lane::light, Lane::heavy));

TEST_P(WhereTasksMayStepAside, WhatStepsAsideKeepsNobodyWaiting) {
  Lanes lanes({.threads = 1, .light = hasty, .heavy = hasty});
  std::latch aside{2};
  std::latch released{1};
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(lanes.submit(GetParam(), {.cost = as_thought, .task = [&] {
                                            lanes.make_room(never);
                                            lanes.make_room(never);
                                            aside.count_down();
                                            released.wait();
                                          }}));
  }
  std::atomic<bool> third_began{false};
  EXPECT_TRUE(lanes.submit(GetParam(), {.task = [&] { third_began = true; }}));
  aside.wait();  // the second runs beside the first
  std::this_thread::sleep_for(20ms);
  EXPECT_FALSE(third_began) << "one at a time may step aside where there is one thread";
  released.count_down();
  lanes.wait_until_idle();
  EXPECT_TRUE(third_began);
  EXPECT_EQ(lanes.gauges(GetParam()).running, 0u);
}

TEST(Lanes, WhatIsNoLongerThanItsLaneAllowsMakesNoRoom) {
  Lanes lanes({.threads = 1, .light = {.longest_wait = 1e9, .waiting = 100, .longest_task = 1e9}});
  std::latch asked{1};
  std::latch released{1};
  EXPECT_TRUE(lanes.submit(Lane::light, {.cost = 0, .task = [&] {
                                           lanes.make_room(never);
                                           asked.count_down();
                                           released.wait();
                                         }}));
  std::atomic<bool> next_began{false};
  EXPECT_TRUE(lanes.submit(Lane::light, {.task = [&] { next_began = true; }}));
  asked.wait();
  std::this_thread::sleep_for(20ms);
  EXPECT_FALSE(next_began);
  released.count_down();
  lanes.wait_until_idle();
}

void soon(const std::function<bool()>& is_so) {
  for (int i = 0; i < 500 && !is_so(); ++i) std::this_thread::sleep_for(10ms);
  EXPECT_TRUE(is_so());
}

/// A task that is far longer than it was thought to be.
class MisjudgedWork : public testing::Test {
 protected:
  void begin_misjudged(int rooms = 1, const std::function<bool()>& given_up = never) {
    EXPECT_TRUE(lanes_.submit(Lane::light, {.cost = 0, .task = [this, given_up, rooms] {
                                              for (int i = 0; i < rooms; ++i) {
                                                compute_for(20ms);
                                                lanes_.make_room(given_up);
                                                ++went_on_;
                                              }
                                            }}));
  }
  static void compute_for(std::chrono::milliseconds time) {
    const auto end = std::clock() + time.count() * CLOCKS_PER_SEC / 1000;
    while (std::clock() < end) continue;
  }
  bool has_nothing_of(Lane lane) const {
    return lanes_.gauges(lane).running + lanes_.gauges(lane).waiting == 0;
  }

  std::atomic<int> went_on_{0};
  Lanes lanes_{{.threads = 1, .light = hasty, .heavy = hasty, .lengthy = patient}};
};

TEST_F(MisjudgedWork, WaitsInTheNextLane) {
  Occupied heavy(lanes_, Lane::heavy);
  heavy.wait_until_begun();
  begin_misjudged();
  soon([&] { return lanes_.gauges(Lane::heavy).waiting == 1; });
  std::atomic<bool> light_began{false};
  EXPECT_TRUE(lanes_.submit(Lane::light, {.task = [&] { light_began = true; }}));
  soon([&] { return light_began.load(); });
  EXPECT_EQ(went_on_, 0);
  heavy.release();
  soon([&] { return went_on_ == 1; });
  soon([&] { return has_nothing_of(Lane::heavy) && has_nothing_of(Lane::light); });
}

TEST_F(MisjudgedWork, GoesOnToTheLastLane) {
  Occupied lengthy(lanes_, Lane::lengthy);
  lengthy.wait_until_begun();
  begin_misjudged(20);
  soon([&] { return lanes_.gauges(Lane::lengthy).waiting == 1; });
  EXPECT_GE(went_on_, 1) << "it ran in the heavy lane before";
  Occupied heavy(lanes_, Lane::heavy);
  heavy.wait_until_begun();
  heavy.release();
  lengthy.release();
  soon([&] { return went_on_ == 20; });
  lanes_.wait_until_idle();
  for (const Lane lane : all_lanes) EXPECT_TRUE(has_nothing_of(lane));
}

TEST_F(MisjudgedWork, IsNotWaitedForWhenItIsGivenUp) {
  Occupied heavy(lanes_, Lane::heavy);
  heavy.wait_until_begun();
  std::atomic<bool> is_left{false};
  begin_misjudged(1, [&] { return is_left.load(); });
  soon([&] { return lanes_.gauges(Lane::heavy).waiting == 1; });
  is_left = true;
  soon([&] { return went_on_ == 1; });
  heavy.release();
  soon([&] { return has_nothing_of(Lane::heavy); });
}

TEST_F(MisjudgedWork, IsFinishedBeforeTheLanesEnd) {
  for (int i = 0; i < 50; ++i) begin_misjudged();
  lanes_.wait_until_idle();
  EXPECT_EQ(went_on_, 50);
}

TEST(Lanes, WhatWasGivenUpTellsNoPace) {
  Lanes lanes({.threads = 1, .heavy = {.longest_wait = 0.1, .waiting = 1000}});
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(
        lanes.submit(Lane::heavy, {.cost = 1000, .task = [&] { lanes.make_way(Lanes::Outcome::given_up); }}));
    lanes.wait_until_idle();
  }
  Occupied first(lanes, Lane::heavy);
  first.wait_until_begun();
  EXPECT_TRUE(lanes.submit(Lane::heavy, {.cost = 200, .task = [] {}}));
  EXPECT_FALSE(lanes.submit(Lane::heavy, {.cost = 1, .task = [] {}})) << "behind 200 ms";
  first.release();
}

TEST(Lanes, WorkOfManyThreadsIsDoneOnceEach) {
  std::atomic<int> done{0};
  std::atomic<int> admitted{0};
  Lanes lanes({.threads = 3, .light = {.longest_wait = 1e9, .waiting = 8}});
  std::vector<std::jthread> clients;
  for (int k = 0; k < 4; ++k) {
    clients.emplace_back([&, k] {
      for (int i = 0; i < 500; ++i) {
        if (lanes.submit(k % 2 == 0 ? Lane::light : Lane::heavy, {.bytes = 1, .task = [&] { ++done; }}))
          ++admitted;
      }
    });
  }
  clients.clear();
  lanes.wait_until_idle();
  EXPECT_EQ(done, admitted);
  EXPECT_EQ(lanes.gauges(Lane::light).running + lanes.gauges(Lane::heavy).waiting, 0u);
}

}  // namespace
}  // namespace qdot::server
