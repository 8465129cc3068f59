#include "server/ordered_work.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>

namespace qdot::server {
namespace {

using namespace std::chrono_literals;

TEST(OrderedWork, WritesInTheOrderOfTheLinesWhateverTheyTake) {
  std::string written;
  std::uint64_t lines = 0, bytes = 0;
  OrderedWork work(
      4,
      [](const InputLine& line) {
        if (line.text.ends_with("0")) std::this_thread::sleep_for(2ms);
        return line.text + "\n";
      },
      [&](const OrderedWork::Piece& piece) {
        written += piece.text;
        lines += piece.lines;
        bytes += piece.input_bytes;
      });
  std::string expected;
  for (int i = 0; i < 20000; ++i) {
    work.add({.text = std::to_string(i), .bytes = 3});
    expected += std::to_string(i) + "\n";
  }
  work.finish();
  EXPECT_EQ(written, expected);
  EXPECT_EQ(lines, 20000U);
  EXPECT_EQ(bytes, 60000U);
}

TEST(OrderedWork, WhatAWriteThrowsReachesTheReader) {
  OrderedWork work(
      2, [](const InputLine&) { return std::string(1000, 'x'); },
      [](const OrderedWork::Piece&) { throw std::runtime_error("full"); });
  EXPECT_THROW(
      {
        for (int i = 0; i < 1'000'000; ++i) work.add({.text = "line"});
      },
      std::runtime_error);
  EXPECT_THROW(work.finish(), std::runtime_error);
}

TEST(OrderedWork, WhatWaitsBehindASlowLineIsBounded) {
  std::atomic<bool> released{false};
  std::atomic<int> answered{0};
  OrderedWork work(
      2,
      [&](const InputLine& line) {
        if (line.text == "slow") {
          while (!released) std::this_thread::sleep_for(1ms);
        }
        ++answered;
        return std::string(1 << 20, 'x');
      },
      [](const OrderedWork::Piece&) {});
  work.add({.text = "slow"});
  std::thread reader([&] {
    for (int i = 0; i < 500; ++i) work.add({.text = "quick"});
    work.finish();
  });
  std::this_thread::sleep_for(300ms);
  EXPECT_LT(answered, 40);
  released = true;
  reader.join();
  EXPECT_EQ(answered, 501);
}

}  // namespace
}  // namespace qdot::server
