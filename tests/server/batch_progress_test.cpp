#include "server/batch_progress.hpp"

#include <gtest/gtest.h>

namespace qdot::server {
namespace {

TEST(BatchProgress, OfAPipeItTellsTheLines) {
  EXPECT_EQ(progress_text({.lines = 1, .bytes = 100, .seconds = 60}), "1 line");
}

TEST(BatchProgress, WhatIsLeftIsToldByWhatThisRunHasDone) {
  EXPECT_EQ(
      progress_text({.lines = 100, .bytes = 250, .bytes_before = 0, .bytes_in_all = 1000, .seconds = 10}),
      "100 lines, 25 %, about 30 s left");
  EXPECT_EQ(
      progress_text({.lines = 900, .bytes = 900, .bytes_before = 800, .bytes_in_all = 1000, .seconds = 600}),
      "900 lines, 90 %, about 10 min left");
}

TEST(BatchProgress, TooSoonThereIsNoEstimate) {
  EXPECT_EQ(progress_text({.lines = 9, .bytes = 90, .bytes_in_all = 1000, .seconds = 1}), "9 lines, 9 %");
  EXPECT_EQ(progress_text({.lines = 9, .bytes = 90, .bytes_before = 90, .bytes_in_all = 1000, .seconds = 9}),
            "9 lines, 9 %");
  EXPECT_EQ(progress_text({.bytes_in_all = 0, .seconds = 9}), "0 lines");
}

}  // namespace
}  // namespace qdot::server
