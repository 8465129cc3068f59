// Systems of more than three unknowns, solved as by hand.

#include "core/expr/solved_by_substitution.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"

namespace qdot::solved_by_substitution_test {
namespace {

const std::vector<std::string> names{"m", "r", "g", "theta"};

class Substitution : public testing::Test {
 protected:
  std::vector<Expression> read(const std::vector<std::string>& texts) {
    std::vector<Expression> found;
    for (const std::string& text : texts) found.push_back(parse(text, graph_, names));
    return found;
  }
  Matrix rows(const std::vector<std::vector<std::string>>& texts) {
    Matrix found;
    for (const auto& row : texts) found.push_back(read(row));
    return found;
  }

  Graph graph_;
};

TEST_F(Substitution, SolvesWhatIsLeftByCramersRule) {
  const Matrix m = rows({{"m", "0", "-1", "0", "0"},
                         {"0", "m", "0", "-1", "0"},
                         {"0", "0", "sin(theta)", "-cos(theta)", "m*r"},
                         {"1", "0", "0", "0", "-r*sin(theta)"},
                         {"0", "1", "0", "0", "r*cos(theta)"}});
  const std::vector<Expression> b = read({"0", "-m*g", "0", "m", "r"});
  const std::vector<Expression> x = solved_by_substitution(m, b);
  ASSERT_EQ(x.size(), b.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    Expression sum = -b[i];
    for (std::size_t j = 0; j < x.size(); ++j) sum = sum + m[i][j] * x[j];
    EXPECT_TRUE(simplify(sum).is_zero()) << i;
  }
}

TEST_F(Substitution, LeavesNoSymbolThatWasDividedBy) {
  const Matrix m =
      rows({{"m", "r", "0", "0"}, {"r", "m", "r", "0"}, {"0", "r", "m", "r"}, {"0", "0", "r", "m"}});
  const std::vector<Expression> x = solved_by_substitution(m, read({"g", "0", "0", "0"}));
  ASSERT_EQ(x.size(), 4U);
  EXPECT_EQ(print(x[3], Form::text, {names, {}, {}}), "-r^3*g/(m^4 + r^2*(r^2 - 3*m^2))");
}

TEST_F(Substitution, GivesUpWhereBracketsWouldBeDividedBy) {
  std::vector<std::string> row(4, "sin(theta)");
  Matrix m;
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<std::string> here = row;
    here[i] = "cos(theta)";
    m.push_back(read(here));
  }
  EXPECT_TRUE(solved_by_substitution(m, read({"1", "0", "0", "0"})).empty());
}

}  // namespace
}  // namespace qdot::solved_by_substitution_test
