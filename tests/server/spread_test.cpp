#include "server/spread.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <latch>
#include <thread>

#include "server/lanes.hpp"

namespace qdot::server {
namespace {

using namespace std::chrono_literals;

TEST(Spread, EachTaskIsTakenOnce) {
  for (const int threads : {1, 2, 5}) {
    std::array<std::atomic<int>, 100> times{};
    spread_over(threads)(times.size(), [&](std::size_t i) { return ++times[i] == 1; });
    for (const std::atomic<int>& one : times) EXPECT_EQ(one, 1);
  }
}

TEST(Spread, TellsWhatOthersComputeWhileItWaits) {
  std::latch taken{1};
  std::atomic<bool> is_enough{false};
  double helped = 0;
  const auto asks = std::this_thread::get_id();
  const api::Spread spread = spread_over(2, Help::as_it_is, [&](double seconds) {
    helped += seconds;
    is_enough = helped > 0.05;
  });
  spread(2, [&](std::size_t) {
    if (std::this_thread::get_id() == asks) {
      taken.wait();
      return true;
    }
    taken.count_down();
    while (!is_enough) {
    }
    return true;
  });
  EXPECT_GT(helped, 0.05);
}

/// As a batch does, whose last line another thread has.
TEST(Spread, WhatAnotherThreadComputesForATaskIsItsOwn) {
  Lanes lanes({.threads = 1});
  std::latch taken{1};
  std::atomic<bool> other_began{false};
  const auto never = [] { return false; };
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_TRUE(lanes.submit(Lane::light,
                           {.cost = 0, .task = [&] {
                              const auto asks = std::this_thread::get_id();
                              const api::Spread spread = spread_over(2, Help::as_it_is, [&](double helped) {
                                Lanes::count_help(helped);
                                lanes.make_room(never);
                              });
                              spread(2, [&](std::size_t) {
                                if (std::this_thread::get_id() == asks) {
                                  taken.wait();
                                  return true;
                                }
                                taken.count_down();
                                while (!other_began && std::chrono::steady_clock::now() < begun + 30s) {
                                }
                                return true;
                              });
                            }}));
  taken.wait();
  EXPECT_TRUE(lanes.submit(Lane::light, {.task = [&] { other_began = true; }}));
  lanes.wait_until_idle();
  EXPECT_LT(std::chrono::steady_clock::now(), begun + 30s) << "it kept its place";
}

}  // namespace
}  // namespace qdot::server
