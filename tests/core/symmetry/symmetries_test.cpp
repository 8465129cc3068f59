// Residues are a field, dependences are found, and symmetries of a bare Lagrangian are proved.

#include "core/symmetry/symmetries.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/expr/print/print.hpp"
#include "core/mechanics/model.hpp"
#include "core/symmetry/dependence.hpp"

namespace qdot {
namespace {

TEST(Residues, AreAFieldInWhichEveryNumberHasARoot) {
  const Modular third = *Modular::of(Number::ratio(-1, 3));
  EXPECT_EQ(third + third + third, -Modular(1));
  EXPECT_EQ(third.small_number(), Number::ratio(-1, 3));
  for (std::uint64_t n = 2; n < 50; ++n) {
    const auto root = square_root({Modular(n), {}});
    ASSERT_TRUE(root);
    EXPECT_TRUE((*root * *root - Residue{Modular(n), {}}).is_zero()) << n;
    const Residue a{Modular(n), Modular(n + 7)};
    EXPECT_TRUE((a * inverse(a) - Residue{Modular(1), {}}).is_zero());
    const auto again = square_root(a * a);
    ASSERT_TRUE(again);
    EXPECT_TRUE((*again * *again - a * a).is_zero());
  }
}

TEST(Residues, KnowLargeNumbers) {
  const auto big = Number::written("123456789012345678901234567890");
  const Modular residue = *Modular::of(*big);
  EXPECT_EQ(residue - *Modular::of(*big - Number(5)), Modular(5));
}

TEST(Dependences, AreThoseOfTheColumns) {
  RowSpace space(3);  // the third column is twice the first less the second
  EXPECT_TRUE(space.add({Modular(1), Modular(5), -Modular(3)}));
  EXPECT_TRUE(space.add({Modular(2), Modular(1), Modular(3)}));
  EXPECT_FALSE(space.add({Modular(3), Modular(6), Modular(0)}));
  const auto basis = space.dependences();
  ASSERT_EQ(basis.size(), 1U);
  EXPECT_EQ(basis[0], (std::vector<Modular>{-Modular(2), Modular(1), Modular(1)}));
}

Scene bare(const std::string& lagrangian) {
  Scene scene;
  scene.name = "bare";
  scene.without_units = true;
  scene.lagrangian = lagrangian;
  scene.parameters.push_back({"a", "1", "1", {}, "", ""});
  for (const char* name : {"x", "y"}) scene.coordinates.push_back({name, "1", "1", "0", "", {}, "", ""});
  return scene;
}

SymmetrySearch searched(const std::string& lagrangian) {
  const auto model = build_model(bare(lagrangian));
  return affine_symmetries(model->lagrangian, conserved_quantities(model->lagrangian, model->scene));
}

TEST(Symmetries, OfARotationAboutAnotherPointHaveTheParameter) {
  const SymmetrySearch search = searched("(x_dot^2 + y_dot^2)/2 - ((x - a)^2 + y^2)^2");
  ASSERT_EQ(search.found.size(), 1U);
  EXPECT_TRUE(search.is_complete);
  EXPECT_EQ(print(search.found[0].change.shift[0], Form::text), "-y");
  EXPECT_EQ(print(search.found[0].change.shift[1], Form::text), "x - a");
}

/// Total derivatives of functions of x, y and t, and a magnetic field beside one.
TEST(Symmetries, AreNotHiddenByTotalDerivatives) {
  for (const char* derivative :
       {"y_dot*sin(t) + y*cos(t)", "y_dot*t^2 + 2*y*t", "exp(t)*(y_dot + y)", "cos(x)*x_dot",
        "cos(x)*sin(y)*x_dot + sin(x)*cos(y)*y_dot", "x^2*y*y_dot + x*y^2*x_dot",
        "cos(x)*cos(t)*x_dot - sin(x)*sin(t)", "a*(x*y_dot - y*x_dot) + cos(x)*x_dot",
        "a*(x*y_dot - y*x_dot) + t*x*y_dot + t*x_dot*y + x*y",
        "a*(x*y_dot - y*x_dot) + x_dot*y*cos(x) + y_dot*sin(x)", "2*t*x*x_dot/(x^2 + 1) + log(x^2 + 1)",
        "(1 + t)*cos(x + x*t)*x_dot + x*cos(x + x*t)"}) {
    const SymmetrySearch search =
        searched(std::string("(x_dot^2 + y_dot^2)/2 - (x^2 + y^2)^2 + ") + derivative);
    const bool turns = std::ranges::any_of(search.found, [](const Symmetry& one) {
      return one.change.time.is_zero() && print(one.change.shift[0], Form::text) == "-y" &&
             print(one.change.shift[1], Form::text) == "x";
    });
    EXPECT_TRUE(turns) << derivative;
  }
}

TEST(Symmetries, AreNotClaimedWhereThereIsNone) {
  for (const char* lagrangian :
       {"(x_dot^2 + y_dot^2)/2 - x^4 - y^4", "(x_dot^2 + a*y_dot^2)/2 - (x^2 + y^2)^2",
        "(x_dot^2 + y_dot^2)/2 - sin(x)*y", "(x_dot^2 + y_dot^2)/2 - x*y*cos(t)",
        "(x_dot^2 + y_dot^2)/2 - x^4 - y^4 + cos(x)*x_dot + x^2*y_dot*sin(t)"}) {
    const SymmetrySearch search = searched(lagrangian);
    EXPECT_TRUE(search.found.empty()) << lagrangian;
    EXPECT_TRUE(search.is_complete) << lagrangian;
  }
}

}  // namespace
}  // namespace qdot
