#include "api/json/embedded_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace qdot::api {
namespace {

constexpr std::array files{EmbeddedFile{"modes.json", "{}"}, EmbeddedFile{"energy.json", "[]"}};

TEST(EmbeddedFile, IsFoundByItsName) { EXPECT_EQ(text_of(files, "energy.json"), "[]"); }

TEST(EmbeddedFile, ThatIsNotThereIsNamedByTheError) {
  EXPECT_THAT([] { (void)text_of(files, "speed.json"); },
              testing::ThrowsMessage<std::logic_error>(testing::HasSubstr("\"speed.json\"")));
}

}  // namespace
}  // namespace qdot::api
