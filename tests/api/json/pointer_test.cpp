#include "api/json/pointer.hpp"

#include <gtest/gtest.h>

namespace qdot::api {
namespace {

TEST(Pointers, AreUriFragments) {
  EXPECT_EQ(below(below(std::string(root_pointer), "parameters"), "kk"), "#/parameters/kk");
  EXPECT_EQ(below("#/times", 3), "#/times/3");
  EXPECT_EQ(below("#", "a/b~c d\xC3\xA4%"), "#/a~1b~0c%20d%C3%A4%25");
}

TEST(Pointers, RepeatTheVelocityOfTheLongestNameWholeAndNothingLonger) {
  const std::string_view text = "vvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvvv_dots";
  const std::string_view velocity = text.substr(0, limits::name_bytes + 4);
  EXPECT_TRUE(velocity.ends_with("v_dot"));
  EXPECT_EQ(below("#", velocity).substr(2), velocity);
  EXPECT_EQ(below("#", text), "#");
}

}  // namespace
}  // namespace qdot::api
