#include "core/steady/combined_forces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class CombinationsTest : public testing::Test {
 protected:
  [[nodiscard]] Expression parsed(const std::string& text) {
    const std::vector<std::string> names{"x", "y", "z", "k", "c"};
    return parse(text, graph_, names);
  }
  [[nodiscard]] std::vector<Expression> combined(const std::vector<std::string>& texts) {
    std::vector<Expression> equations;
    for (const std::string& text : texts) equations.push_back(parsed(text));
    return combinations(equations);
  }

 private:
  Graph graph_;
};

TEST_F(CombinationsTest, CancelWhatTwoEquationsShare) {
  EXPECT_THAT(combined({"k*sin(x + y) + c*x", "2*k*sin(x + y) - y"}),
              testing::ElementsAre(simplify(parsed("c*x + y/2"))));
}

TEST_F(CombinationsTest, CancelTwoTermsOfThreeEquations) {
  EXPECT_THAT(combined({"exp(x) + y^3 + z", "exp(x) - y^3", "2*exp(x) + 3*y^3"}),
              testing::Contains(parsed("z")));
}

TEST_F(CombinationsTest, ThereAreNoneWhereNothingIsShared) {
  EXPECT_TRUE(combined({"x^3 - x", "exp(y)"}).empty());
  EXPECT_TRUE(combined({"x^3 - x"}).empty());
}

}  // namespace
}  // namespace qdot
