// Constraints: their equations, their forces in Lagrange's, and those that say nothing new.

#include "core/mechanics/constraints.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/conserved.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {
namespace {

Scene point_in_plane(const std::vector<std::string>& expressions) {
  Scene scene;
  scene.name = "point";
  for (const char* name : {"m", "l", "w"})
    scene.parameters.push_back({name, name[0] == 'm' ? "kg" : name[0] == 'l' ? "m" : "1/s", "1", {}, "", ""});
  for (const char* name : {"x", "y"}) scene.coordinates.push_back({name, "m", "0", "0", "", {}, "", ""});
  scene.bodies.push_back(Particle{"", "m", {"", {"x", "y"}}});
  for (const std::string& e : expressions)
    scene.constraints.push_back({"c" + std::to_string(scene.constraints.size() + 1), e, "", ""});
  return scene;
}

std::string text(const Expression& e) { return print(simplify(e), Form::text); }

TEST(Constraints, AreDifferentiatedTwice) {
  const auto model = build_model(point_in_plane({"x^2 + y^2 - l^2"}));
  const ConstraintEquation& circle = model->lagrangian.constraints.at(0);
  EXPECT_EQ(text(circle.rate), "2*(x*x_dot + y*y_dot)");
  EXPECT_EQ(text(circle.slope[0]), "2*x");
  EXPECT_EQ(text(circle.rest), "2*(x_dot^2 + y_dot^2)");
  EXPECT_TRUE(is_workless(circle, model->parsed.symbols));
  EXPECT_EQ(text(model->equations.equations[0].right), "2*lambda_c1*x");
  EXPECT_EQ(text(model->equations.reactions[1][0]), "2*y");
  EXPECT_TRUE(model->equations.forcing[0].is_zero());
  EXPECT_EQ(model->parsed.constraints[0].multiplier_unit, "kg/s^2");
}

TEST(Constraints, ThatMoveDoWork) {
  const auto model = build_model(point_in_plane({"x - l*sin(w*t)"}));
  EXPECT_FALSE(is_workless(model->lagrangian.constraints[0], model->parsed.symbols));
  for (const ConservedQuantity& quantity : conserved_quantities(model->lagrangian, model->scene))
    EXPECT_EQ(quantity.name, "p_y");
  const auto resting = build_model(point_in_plane({"x - l"}));
  EXPECT_EQ(conserved_quantities(resting->lagrangian, resting->scene)[0].name, "energy");
}

TEST(Constraints, InTheVelocitiesHaveTheirOwnSlopes) {
  const auto model = build_model(point_in_plane({"y_dot*l - x*x_dot"}));
  const ConstraintEquation& equation = model->lagrangian.constraints[0];
  EXPECT_FALSE(equation.position);
  EXPECT_EQ(text(equation.slope[0]), "-x");
  EXPECT_EQ(text(equation.slope[1]), "l");
  EXPECT_EQ(text(equation.rest), "-x_dot^2");
}

TEST(Constraints, ThatSayNothingNewAreFound) {
  const auto found = [](const std::vector<std::string>& expressions) {
    try {
      (void)build_model(point_in_plane(expressions));
    } catch (const SceneError& error) {
      return error.diagnostics().at(0).place + " " + error.diagnostics().at(0).code;
    }
    return std::string("none");
  };
  EXPECT_EQ(found({"x - l", "y - l"}), "none");
  EXPECT_EQ(found({"x - l", "x - 2*l"}), "/constraints/1 redundant");
  EXPECT_EQ(found({"x*y - l^2", "log(x/l) + log(y/l)"}), "/constraints/1 redundant");
  EXPECT_EQ(found({"x - l", "x_dot"}), "/constraints/1 redundant");
  EXPECT_EQ(found({"x^2 + y^2 - l^2", "sin(x/l)^2 + cos(x/l)^2 - y/l"}), "none");
}

TEST(Constraints, CarryWhatHasNoMass) {
  Scene scene = point_in_plane({"s - x"});
  scene.coordinates.push_back({"s", "m", "0", "0", "", {}, "", ""});
  EXPECT_NO_THROW((void)build_model(scene));
  scene.constraints.clear();
  EXPECT_THROW((void)build_model(scene), SceneError);
}

}  // namespace
}  // namespace qdot
