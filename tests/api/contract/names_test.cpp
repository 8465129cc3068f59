#include "api/contract/names.hpp"

#include <gtest/gtest.h>

#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

TEST(Names, MayBeAsLongAsTheLimit) {
  EXPECT_TRUE(is_name(std::string(limits::name_bytes, 'a')));
  EXPECT_FALSE(is_name(std::string(limits::name_bytes + 1, 'a')));
  EXPECT_TRUE(is_name("Omega_0"));
  EXPECT_TRUE(is_name("dot"));
}

TEST(Names, OfVelocitiesAreNamesWithDotAfterThem) {
  EXPECT_FALSE(is_name("theta_dot"));
  EXPECT_TRUE(is_name("theta_dot", NameOf::thing_or_velocity));
  EXPECT_TRUE(is_name("theta", NameOf::thing_or_velocity));
  for (const char* text : {"theta_ddot", "theta_dot_dot", "t_dot", "_dot", "sin"}) {
    EXPECT_FALSE(is_name(text, NameOf::thing_or_velocity)) << text;
  }
}

}  // namespace
}  // namespace qdot::api
