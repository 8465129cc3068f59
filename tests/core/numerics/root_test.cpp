#include "core/numerics/root.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace qdot {
namespace {

struct Search {
  SignChange place;
  int evaluations;
};

Search search(const std::function<double(double)>& function, double a, double b) {
  int evaluations = 0;
  const auto counted = [&](double t) {
    ++evaluations;
    return function(t);
  };
  const SignChange place = find_sign_change(counted, {a, function(a), b, function(b)});
  return {place, evaluations};
}

TEST(SignChange, RootsAreFoundToRoundOff) {
  const double half_pi = std::acos(0.);
  for (const double b : {1.6, 2.0, 4.0}) {
    const auto [place, evaluations] = search([](double t) { return std::cos(t); }, 0, b);
    EXPECT_NEAR(place.after, half_pi, time_round_off(b));
    EXPECT_LE(place.value_after, 0);
    EXPECT_GT(place.value_before, 0);
    EXPECT_LT(evaluations, 14) << b;  // bisection: 51
  }
}

TEST(SignChange, NoFunctionTakesMuchMoreThanBisection) {
  const double root = 1.234567;
  for (const double power : {1. / 9, 3., 9., 21.}) {
    const auto [place, evaluations] =
        search([&](double t) { return std::copysign(std::pow(std::abs(t - root), power), t - root); }, 0, 10);
    EXPECT_NEAR(place.after, root, time_round_off(10)) << power;
    EXPECT_LE(evaluations, 60) << power;  // log2(10 / round-off) = 53.2 at 10, 56.2 at the root, and two each
  }
}

TEST(SignChange, JumpIsBracketedByNeighbours) {
  const auto [place, evaluations] = search([](double t) { return t < 1. / 3 ? -1. : 1.; }, 0, 1);
  EXPECT_LT(place.before, 1. / 3);
  EXPECT_GE(place.after, 1. / 3);
  EXPECT_LE(place.after - place.before, time_round_off(1));
  EXPECT_LE(evaluations, 55);
}

TEST(SignChange, APlaceFarBelowTheEndsOfItsBracketIsFoundToItsOwnRoundOff) {
  const double root = std::sqrt(2.) / 10;
  for (const double b : {1., 100., 1e6}) {
    const auto [place, evaluations] = search([&](double t) { return 0.02 - t * t; }, 0, b);
    EXPECT_NEAR(place.after, root, time_round_off(root)) << b;
    EXPECT_LE(evaluations, std::log2(b / root) + 60) << b;
  }
}

TEST(SignChange, ExactZeroIsThePlace) {
  const auto [place, evaluations] = search([](double t) { return t - 0.5; }, 0, 1);
  EXPECT_EQ(place.after, 0.5);
  EXPECT_EQ(place.value_after, 0);
  EXPECT_EQ(evaluations, 1);
}

TEST(SignChange, UndefinedValuesCountAsTheOldSign) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto [place, evaluations] = search([&](double t) { return t < 0.2 ? -1 : t < 0.7 ? nan : 1.; }, 0, 1);
  EXPECT_NEAR(place.after, 0.7, time_round_off(1));
  EXPECT_LE(evaluations, 55);
}

TEST(SignChange, HugeTinyAndDenormalBracketsEnd) {
  EXPECT_NEAR(search([](double t) { return t - 1e300; }, 0, 1.7e308).place.after, 1e300,
              time_round_off(1.7e308));
  EXPECT_NEAR(search([](double t) { return t - 1e-290; }, 0, 1).place.after, 1e-290, time_round_off(1));
  EXPECT_LE(search([](double t) { return t - 1e-310; }, 0, 1e-300).place.after, 1e-300);
  const double next = std::nextafter(1, 2);
  EXPECT_EQ(search([](double t) { return t - 1.5 > -0.5 ? 1. : -1.; }, 1, next).place.after, next);
}

}  // namespace
}  // namespace qdot
