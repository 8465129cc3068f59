// Impacts that follow from what they touch, against impulses on paper.

#include "core/mechanics/impacts.hpp"

#include <gtest/gtest.h>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/model.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

/// What an expression of the model means, in short form.
Expression meaning(const Model& model, const std::string& text) {
  Graph& graph = *model.parsed.graph;
  std::vector<std::string> names;
  for (const auto* symbols : {&model.parsed.symbols.parameters, &model.parsed.symbols.coordinates.value,
                              &model.parsed.symbols.coordinates.rate}) {
    for (const Expression& symbol : *symbols) names.push_back(std::get<Symbol>(symbol.node()).name);
  }
  return *parse_all(text, graph, names).expression;
}

Expression after(const Model& model, const std::string& name) {
  for (const auto& [symbol, value] : model.parsed.impacts.front().map) {
    if (std::get<Symbol>(symbol.node()).name == name) return value;
  }
  return model.parsed.graph->symbol(name);
}

TEST(Impacts, OfTheWalkerKeepItsAngularMomenta) {
  const auto model = test::model_of("compass_walker");
  for (const auto& [name, known] : std::vector<std::pair<std::string, std::string>>{
           {"theta", "-theta"},
           {"phi", "-2*theta"},
           {"theta_dot", "cos(2*theta)*theta_dot/(1 + m/M*sin(2*theta)^2)"},
           {"phi_dot", "(1 - cos(2*theta))*cos(2*theta)*theta_dot/(1 + m/M*sin(2*theta)^2)"}}) {
    const Expression difference = after(*model, name) - meaning(*model, known);
    std::vector<Assignment> values;
    double x = 0.1;
    for (const auto* symbols : {&model->parsed.symbols.parameters, &model->parsed.symbols.coordinates.value,
                                &model->parsed.symbols.coordinates.rate}) {
      for (const Expression& symbol : *symbols) values.emplace_back(symbol, x += 0.13);
    }
    EXPECT_NEAR(evaluate(difference, values), 0, 1e-14) << name;
    values[1].second = 0;  // massless feet
    EXPECT_NEAR(evaluate(difference, values), 0, 1e-14) << name << " without mass in the feet";
  }
}

Scene ball_over(const std::string& distance) {
  Scene scene;
  scene.name = "ball";
  scene.parameters = {
      {"m", "kg", "1", {}, "", ""}, {"e", "1", "1", {}, "", ""}, {"v", "m/s", "1", {}, "", ""}};
  for (const char* name : {"x", "y"}) scene.coordinates.push_back({name, "m", "0", "0", "", {}, "", ""});
  scene.bodies.push_back(Particle{"", "m", {"", {"x", "y"}}});
  scene.events.push_back({"touch", distance, Crossing::falling, "", ""});
  scene.impact = Impact{.event = "touch", .map = {}, .meaning = "", .restitution = "e"};
  return scene;
}

TEST(Impacts, ReturnPartOfTheSpeedAlongTheNormalOnly) {
  const auto floor = build_model(ball_over("y"));
  EXPECT_TRUE(simplify(after(*floor, "y_dot") - meaning(*floor, "-e*y_dot")).is_zero());
  EXPECT_TRUE(after(*floor, "x_dot") == floor->parsed.graph->symbol("x_dot"));
  const auto slope = build_model(ball_over("y - x"));
  EXPECT_TRUE(
      simplify(after(*slope, "x_dot") - meaning(*slope, "x_dot + (1 + e)*(y_dot - x_dot)/2")).is_zero());
  const auto lift = build_model(ball_over("y - v*t"));  // relative to what moves
  EXPECT_TRUE(simplify(after(*lift, "y_dot") - meaning(*lift, "(1 + e)*v - e*y_dot")).is_zero());
}

TEST(Impacts, LeaveWhatConstraintsKeep) {
  Scene scene = ball_over("y");
  scene.constraints = {{"wire", "y - x", "", ""}};
  const auto model = build_model(scene);  // along the wire nothing but the speed turns round
  for (const char* rate : {"x_dot", "y_dot"}) {
    const Expression difference = after(*model, rate) - meaning(*model, "-e*(x_dot + y_dot)/2");
    const auto& q = model->parsed.symbols.coordinates;
    const Replacement along{q.rate[1], q.rate[0]};
    EXPECT_TRUE(simplify(substitute(difference, {&along, 1})).is_zero()) << rate;
  }
  scene.constraints = {{"rail", "y", "", ""}};
  EXPECT_THROW((void)build_model(scene), SceneError) << "the floor is never reached";
}

TEST(Impacts, OfSeveralEventsHaveTheirOwnMaps) {
  Scene scene = ball_over("y");
  scene.events.push_back({"wall", "x", Crossing::falling, "", ""});
  scene.impacts = {*scene.impact, {.event = "wall", .map = {{"x_dot", "0"}}}};
  scene.impact.reset();
  const auto model = build_model(scene);
  ASSERT_EQ(model->parsed.impacts.size(), 2U);
  EXPECT_TRUE(simplify(after(*model, "y_dot") - meaning(*model, "-e*y_dot")).is_zero());
  EXPECT_EQ(model->parsed.impacts[1].event, "wall");
  EXPECT_TRUE(model->parsed.impacts[1].map.front().second.is_zero());
  scene.impacts[1].event = "touch";
  EXPECT_THROW((void)build_model(scene), SceneError) << "an event has one impact";
}

TEST(Impacts, ThatTouchNothingAreRefused) {
  EXPECT_THROW((void)build_model(ball_over("x_dot")), SceneError);
  Scene scene = ball_over("y");
  scene.impact->restitution.clear();
  scene.impact->contact_made = "P";
  scene.points = {{"P", {"x", "y"}}, {"Q", {"0", "y"}}};
  EXPECT_THROW((void)build_model(scene), SceneError) << "what is left?";
  scene.impact->contact_left = "Q";
  EXPECT_THROW((void)build_model(scene), SceneError) << "it moves";
}

}  // namespace
}  // namespace qdot
