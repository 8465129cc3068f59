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

TEST(Pointers, AreReadStepByStep) {
  using Steps = std::vector<std::string>;
  EXPECT_EQ(steps_of("/modes/0/omega"), (Steps{"modes", "0", "omega"}));
  EXPECT_EQ(steps_of("/a~1b~0c//d%20"), (Steps{"a/b~c", "", "d%20"}));
  EXPECT_EQ(steps_of("/"), (Steps{""}));
  for (const char* none : {"", "modes", "#/modes", "/a~", "/a~2", "/~/b"})
    EXPECT_EQ(steps_of(none), std::nullopt) << none;
}

TEST(Pointers, LeadIntoArraysByIndicesOnly) {
  EXPECT_EQ(index_of("0"), 0U);
  EXPECT_EQ(index_of("18446744073709551614"), 18446744073709551614U);
  for (const char* none :
       {"", "-", "-1", "+1", "01", "00", "1a", "1.0", "18446744073709551615", "99999999999999999999"})
    EXPECT_EQ(index_of(none), std::nullopt) << none;
  const Json list{{"modes", {1, 2}}, {"01", 3}};
  EXPECT_EQ(*child_at(list, "01"), 3);
  EXPECT_EQ(*child_at(*child_at(list, "modes"), "1"), 2);
  for (const char* nothing : {"2", "01", "18446744073709551616", "omega"})
    EXPECT_EQ(child_at(list["modes"], nothing), nullptr) << nothing;
  EXPECT_EQ(child_at(list["01"], "0"), nullptr);
}

}  // namespace
}  // namespace qdot::api
