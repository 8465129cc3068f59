// What a question may cost: the bound, and the question whether anyone waits.

#include "core/base/work.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"

namespace qdot {
namespace {

TEST(Work, IsUnboundedWithoutAScope) { EXPECT_NO_THROW(spend_work(1'000'000'000)); }

TEST(Work, EndsAtItsBound) {
  const WorkScope scope(10);
  spend_work(10);
  try {
    spend_work();
    FAIL() << "the bound was passed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::too_large);
  }
}

TEST(Work, SaysWhatIsLeft) {
  const WorkScope scope(10);
  spend_work(4);
  EXPECT_EQ(work_left(), 6U);
}

TEST(Work, IsCountedByTheInnermostScope) {
  const WorkScope outer(10);
  {
    const WorkScope inner(1'000);
    EXPECT_NO_THROW(spend_work(1'000));
  }
  EXPECT_NO_THROW(spend_work(10));
  EXPECT_THROW(spend_work(), Error);
}

TEST(Work, IsGivenUpWhenNobodyWaits) {
  bool awaited = true;
  const WorkScope scope(1'000'000, [&awaited] { return !awaited; });
  EXPECT_NO_THROW(spend_work(100'000));
  awaited = false;
  EXPECT_THROW(spend_work(100'000), Interrupted);
  EXPECT_THROW(check_interruption(), Interrupted);
}

}  // namespace
}  // namespace qdot
