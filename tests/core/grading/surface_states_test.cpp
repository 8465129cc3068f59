// States on the surface of constraints: the constraints themselves, evaluated there in balls.

#include "core/grading/surface_states.hpp"

#include <gtest/gtest.h>

namespace qdot {
namespace {

struct Named {
  const char *name, *unit;
};

std::shared_ptr<const Model> model_of(const std::vector<Named>& parameters,
                                      const std::vector<Named>& coordinates, const std::string& lagrangian,
                                      const std::string& constraint) {
  Scene scene;
  scene.name = "constrained";
  for (const auto& [name, unit] : parameters)
    scene.parameters.push_back({name, unit, "1", {.lower = 0, .lower_open = true}, "", ""});
  for (const auto& [name, unit] : coordinates) {
    Coordinate& coordinate = scene.coordinates.emplace_back();
    coordinate.name = name;
    coordinate.unit = unit;
    coordinate.initial = coordinate.initial_rate = "0";
  }
  scene.lagrangian = lagrangian;
  scene.constraints = {{"first", constraint, "", ""}};
  return build_model(scene);
}

/// Constraints and their first derivatives vanish at moved states; how many states were moved.
int moved_to_the_surface(const Model& model) {
  const ExpectedSystem system(model);
  std::vector<Expression> roots;
  for (const ConstraintEquation& constraint : system.constraints()) {
    if (constraint.position) roots.push_back(*constraint.position);
    roots.push_back(constraint.rate);
  }
  const std::vector<SymbolDomain> symbols = system.domains();
  SampledStates states(symbols, 3);
  SurfaceStates surface(system);
  int moved = 0;
  for (int i = 0; i < 40; ++i) {
    State state = states.next();
    if (!surface.move(state)) continue;
    ++moved;
    BallValues values(roots);
    for (std::size_t k = 0; k < symbols.size(); ++k) values.set(symbols[k].symbol, state[k]);
    for (const auto& [symbol, value] : surface.place()) values.set(symbol, value);
    values.evaluate();
    for (const Expression& root : roots) {
      EXPECT_TRUE(values.of(root).contains_zero());
      EXPECT_TRUE(values.vanishes(root));
    }
  }
  return moved;
}

TEST(SurfaceStates, ObeyAConstraintOfPlaces) {
  const auto bead =
      model_of({{"m", "kg"}, {"c", "1/m"}}, {{"x", "m"}, {"y", "m"}}, "m*(x_dot^2 + y_dot^2)/2", "y - c*x^2");
  EXPECT_GE(moved_to_the_surface(*bead), 30);
}

TEST(SurfaceStates, ObeyAConstraintThatMoves) {
  const auto wire = model_of({{"m", "kg"}, {"w", "rad/s"}}, {{"x", "m"}, {"y", "m"}},
                             "m*(x_dot^2 + y_dot^2)/2", "x*sin(w*t) - y*cos(w*t)");
  EXPECT_GE(moved_to_the_surface(*wire), 30);
}

TEST(SurfaceStates, ObeyAConstraintOfVelocities) {
  const auto blade = model_of({{"m", "kg"}, {"J", "kg*m^2"}}, {{"x", "m"}, {"y", "m"}, {"phi", "rad"}},
                              "m*(x_dot^2 + y_dot^2)/2 + J*phi_dot^2/2", "x_dot*sin(phi) - y_dot*cos(phi)");
  EXPECT_GE(moved_to_the_surface(*blade), 30);
}

TEST(SurfaceStates, AreNotFoundWhereThereAreNone) {
  const auto nowhere = model_of({{"m", "kg"}, {"l", "m"}}, {{"x", "m"}, {"y", "m"}},
                                "m*(x_dot^2 + y_dot^2)/2", "x^2 + y^2 + l^2");
  EXPECT_EQ(moved_to_the_surface(*nowhere), 0);
}

}  // namespace
}  // namespace qdot
