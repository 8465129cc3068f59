#include "server/processors.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <fstream>

namespace qdot::server {
namespace {

constexpr const char* no_file = "";

cpu_set_t allowed() {
  cpu_set_t set;
  EXPECT_EQ(::sched_getaffinity(0, sizeof set, &set), 0);
  return set;
}

TEST(UsableProcessors, AreThoseThatTheProcessMayRunOn) {
  const cpu_set_t before = allowed();
  EXPECT_EQ(usable_processors(no_file), CPU_COUNT(&before));
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(usable_processors(no_file), 1);
  ASSERT_EQ(::sched_setaffinity(0, sizeof before, &before), 0);
}

TEST(UsableProcessors, AreNoMoreThanTheQuota) {
  const cpu_set_t set = allowed();
  const int all = CPU_COUNT(&set);
  const std::string file = testing::TempDir() + "cpu.max";
  const auto by = [&](const char* quota) {
    std::ofstream(file) << quota << '\n';
    return usable_processors(file);
  };
  EXPECT_EQ(by("50000 100000"), 1);
  EXPECT_EQ(by("150000 100000"), std::min(all, 2));
  EXPECT_EQ(by("100000000 100000"), all);
  EXPECT_EQ(by("max 100000"), all);
  EXPECT_EQ(by(""), all);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace qdot::server
