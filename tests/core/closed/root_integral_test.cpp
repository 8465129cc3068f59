// Integrals between the zeros of a quadratic: those of textbooks, and none where it is not elementary.

#include "core/closed/root_integral.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"

namespace qdot::root_integral_test {
namespace {

const std::vector<std::string> names{"w", "a", "b", "k", "m"};

class RootIntegral : public testing::Test {
 protected:
  Univariate polynomial(const std::string& text) {
    return *univariate(graph_, multiplied_out(parse(text, graph_, names)), graph_.symbol("w"));
  }
  /// Of sqrt(below/above), all symbols positive.
  std::string integral(const std::string& above, const std::string& below, int passes = 1) {
    const auto found = root_integral(graph_, polynomial(above), polynomial(below), positive, passes);
    return found ? print(*found, Form::text, {names, {}, {}}) : "none";
  }
  static int positive(const Polynomial& a) { return a.begin()->second.is_negative() ? -1 : 1; }

  Graph graph_;
};

TEST_F(RootIntegral, OfAnOscillator) { EXPECT_EQ(integral("2*k - k*w^2", "m", 2), "2*pi*sqrt(m/k)"); }

TEST_F(RootIntegral, OfPowersOfTheUnknown) {
  EXPECT_EQ(integral("4*w - w^2 - 1", "w^2"), "2*pi");                // the mean of the zeros
  EXPECT_EQ(integral("5*w^3 - w^4 - 4*w^2", "1"), "1/2*pi");          // one over the root of their product
  EXPECT_EQ(integral("4*w - w^2 - 1", "w^4"), "11/2*pi");             // (3 b^2 - 4 c)/8
  EXPECT_EQ(integral("5*w^5 - w^6 - 4*w^4", "1"), "5/16*pi");         // -b/(2 c^(3/2))
  EXPECT_EQ(integral("5*w^3 - w^4 - 4*w^2", "(1 + w)^2"), "3/2*pi");  // two of them
}

TEST_F(RootIntegral, WithASquareBelow) { EXPECT_EQ(integral("4*w - w^2 - 1", "(w + 3)^2"), "5*pi"); }

TEST_F(RootIntegral, IsNoneOfACubic) {
  EXPECT_EQ(integral("w^3 - 3*w + 1", "1"), "none");
  EXPECT_EQ(integral("4*w - w^2 - 1", "w + 1"), "none");
}

TEST_F(RootIntegral, FromZeroOfALinearOne) {
  const auto found = root_integral_from_zero(graph_, polynomial("2*a - 2*b*w"), polynomial("m"), positive, 4);
  ASSERT_TRUE(found);
  EXPECT_EQ(print(*found, Form::text, {names, {}, {}}), "4*sqrt(2*a*m)/b");
}

}  // namespace
}  // namespace qdot::root_integral_test
