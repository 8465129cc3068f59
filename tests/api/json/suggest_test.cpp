#include "api/json/suggest.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace qdot::api {
namespace {

TEST(Suggest, DistanceCountsEdits) {
  EXPECT_EQ(edit_distance("theta", "theta"), 0U);
  EXPECT_EQ(edit_distance("theta", "teta"), 1U) << "left out";
  EXPECT_EQ(edit_distance("theta", "thetta"), 1U) << "inserted";
  EXPECT_EQ(edit_distance("theta", "thefa"), 1U) << "replaced";
  EXPECT_EQ(edit_distance("theta", "tehta"), 1U) << "swapped";
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U) << "a swapped pair is not edited again";
}

TEST(Suggest, SameLettersAreTheSameName) {
  const std::vector<std::string> names{"cart_pendulum", "theta", "Omega", "M", "m"};
  EXPECT_EQ(same_letters("Cart-Pendulum", names), "cart_pendulum");
  EXPECT_EQ(same_letters("cart pendulum", names), "cart_pendulum");
  EXPECT_EQ(same_letters("θ", names), "theta");
  EXPECT_EQ(same_letters("omega", names), "Omega");
  EXPECT_EQ(same_letters("m", names), "m") << "the same capital letters come first";
  EXPECT_EQ(same_letters("--", names), "");
}

TEST(Suggest, APartStandsForTheWholeWhereItIsOneOnly) {
  const std::vector<std::string> names{"cart_pendulum", "rod_pendulum", "compass_walker", "simulate"};
  EXPECT_EQ(closest("cart", names), "cart_pendulum");
  EXPECT_EQ(closest("walker", names), "compass_walker");
  EXPECT_EQ(closest("sim", names), "simulate");
  EXPECT_EQ(closest("pendulum", names), "");
  EXPECT_EQ(closest("alker", names), "");
}

TEST(Suggest, CapitalLettersCountAsSmallOnes) {
  EXPECT_EQ(edit_distance("omega", "Omega"), 0U);
  EXPECT_EQ(closest("THETA", std::vector<std::string>{"phi", "theta"}), "theta");
}

TEST(Suggest, TheNearestCandidateWins) {
  const std::vector<std::string> names{"omega", "omega0", "phi"};
  EXPECT_EQ(closest("omga0", names), "omega0");
  EXPECT_EQ(closest("kk", std::vector<std::string>{"m", "k", "l0", "g"}), "k");
}

TEST(Suggest, FarWordsAreNotSuggested) {
  const std::vector<std::string> names{"m", "k", "stiffness"};
  EXPECT_EQ(closest("x", names), "") << "nothing of the word would be left";
  EXPECT_EQ(closest("stuff", names), "");
  EXPECT_EQ(closest(std::string(100'000, 'a'), names), "");
  EXPECT_EQ(closest("k", std::vector<std::string>{}), "");
}

}  // namespace
}  // namespace qdot::api
