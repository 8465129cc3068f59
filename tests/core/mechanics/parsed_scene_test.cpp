// Mistakes in scenes: each has a place, a code and a sentence, and all are found at once.

#include "core/mechanics/parsed_scene.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "tests/support/scenes.hpp"

namespace qdot::parsed_scene_test {
namespace {

using testing::Contains;
using testing::ElementsAre;

std::vector<Diagnostic> mistakes_in(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  (void)parse_scene(scene, diagnostics);
  return diagnostics;
}

MATCHER_P3(IsDiagnostic, place, code, message, "") {
  *result_listener << arg.place << " " << arg.code << ": " << arg.message;
  return arg.place == place && arg.code == code && arg.message == message;
}

struct Mistake {
  std::string name;
  std::function<void(Scene&)> make;
  std::string place, code, message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

/// In the spring pendulum: parameters m, k, l0, g and coordinates l, theta.
const std::vector<Mistake> table{
    {"UnknownSymbolInAPosition", [](Scene& s) { s.points[1].components[0] = "l*sin(phi)"; },
     "/points/1/components/0", "unknown_symbol", "unknown symbol 'phi'."},
    {"UnknownSymbolInADefault", [](Scene& s) { s.parameters[1].default_value = "2*n"; },
     "/parameters/1/default", "unknown_symbol", "unknown symbol 'n'."},
    {"VelocityInAPosition", [](Scene& s) { s.points[1].components[1] = "-l*theta_dot"; },
     "/points/1/components/1", "unknown_symbol", "unknown symbol 'theta_dot': there are no velocities here."},
    {"CoordinateInADefault", [](Scene& s) { s.parameters[2].default_value = "l"; }, "/parameters/2/default",
     "unknown_symbol", "unknown symbol 'l'."},
    {"TimeInAnInitialValue", [](Scene& s) { s.coordinates[1].initial = "t"; }, "/coordinates/1/initial",
     "unknown_symbol", "unknown symbol 't'."},
    {"UnknownPoint",
     [](Scene& s) {
       s.bodies[0] = Particle{"bob", "m", {"bop", {}}};
     },
     "/bodies/0/position", "unknown_point", "There is no point 'bop' in this scene."},
    {"OpenBracket", [](Scene& s) { s.points[1].components[0] = "l*(sin(theta)"; }, "/points/1/components/0",
     "syntax", "expected ')' to close the '(' at byte 2."},
    {"LengthAddedToAngle", [](Scene& s) { s.points[1].components[0] = "l + theta"; },
     "/points/1/components/0", "wrong_dimension",
     "The expression's dimensions do not fit: it adds 'l' in m to 'theta' in 1."},
    {"SineOfALength", [](Scene& s) { s.points[1].components[0] = "l*sin(l)"; }, "/points/1/components/0",
     "wrong_dimension",
     "The expression's dimensions do not fit: it takes sin of 'l', which is in m and not a pure number."},
    {"AreaForAPosition", [](Scene& s) { s.points[1].components[0] = "l^2*sin(theta)"; },
     "/points/1/components/0", "wrong_dimension", "The expression is in m^2, but m belongs here."},
    {"ForceForAPotential", [](Scene& s) { s.potential = "m*g"; }, "/potential", "wrong_dimension",
     "The expression is in kg*m/s^2, but kg*m^2/s^2 belongs here."},
    {"WeightForAMass",
     [](Scene& s) {
       s.bodies[0] = Particle{"bob", "m*g", {"bob", {}}};
     },
     "/bodies/0/mass", "wrong_dimension", "The expression is in kg*m/s^2, but kg belongs here."},
    {"MassForAStiffness", [](Scene& s) { s.springs[0].stiffness = "m"; }, "/springs/0/stiffness",
     "wrong_dimension", "The expression is in kg, but kg/s^2 belongs here."},
    {"ForceForADissipation", [](Scene& s) { s.dissipation = "m*g*theta_dot"; }, "/dissipation",
     "wrong_dimension", "The expression is in kg*m/s^3, but kg*m^2/s^3 belongs here."},
    {"RateForATimeScale", [](Scene& s) { s.scales->time = "k/m"; }, "/scales/time", "wrong_dimension",
     "The expression is in 1/s^2, but s belongs here."},
    {"LengthForAnAngularVelocity", [](Scene& s) { s.coordinates[1].initial_rate = "l0"; },
     "/coordinates/1/initial_rate", "wrong_dimension", "The expression is in m, but 1/s belongs here."},
    {"ParameterNamedTwice",
     [](Scene& s) {
       s.parameters.push_back({"m", "kg", "1", {}, "", ""});
     },
     "/parameters/4/name", "duplicate_name", "The name 'm' is used twice."},
    {"ParameterNamedAsACoordinate",
     [](Scene& s) {
       s.parameters.push_back({"theta", "1", "1", {}, "", ""});
     },
     "/parameters/4/name", "duplicate_name", "The name 'theta' is used twice."},
    {"ParameterNamedAsAVelocity",
     [](Scene& s) {
       s.parameters.push_back({"l_dot", "1", "1", {}, "", ""});
     },
     "/parameters/4/name", "duplicate_name", "The name 'l_dot' is used twice."},
    {"DefaultOfItself", [](Scene& s) { s.parameters[1].default_value = "2*k"; }, "/parameters/1/default",
     "cycle", "The default of 'k' depends on itself."},
    {"NeitherBodiesNorLagrangian",
     [](Scene& s) {
       s.bodies.clear();
       s.gravity.clear();
       s.springs.clear();
     },
     "/bodies", "missing", "A scene has either bodies or a lagrangian."},
    {"BodiesAndLagrangian", [](Scene& s) { s.lagrangian = "m*l_dot^2/2"; }, "/bodies", "missing",
     "A scene has either bodies or a lagrangian."},
    {"LagrangianAndGravity",
     [](Scene& s) {
       s.lagrangian = "m*l_dot^2/2";
       s.bodies.clear();
     },
     "/lagrangian", "exclusive", "A lagrangian contains gravity, springs and potential already."},
    {"OneComponent", [](Scene& s) { s.gravity = {"-g"}; }, "/gravity", "components",
     "Positions and vectors have two components, or all of them three."},
    {"ThreeComponentsInAPlane",
     [](Scene& s) {
       s.gravity = {"0", "-g", "0"};
     },
     "/gravity", "components", "Positions and vectors have two components, or all of them three."},
    {"DiskInSpace",
     [](Scene& s) {
       for (Point& point : s.points) point.components.push_back("0");
       s.gravity.push_back("0");
       RigidBody wheel{.name = "wheel", .mass = "m", .shape = "disk"};
       wheel.sizes = {{"radius", "l0"}};
       wheel.centre.point = s.points[0].name;
       wheel.angle = "theta";
       s.bodies = {wheel};
     },
     "/bodies/0/angle", "not_applicable",
     "In space one angle does not say where a body points: give its 'orientation'."},
    {"ReactionOfNoHeldLength",
     [](Scene& s) {
       s.valid_while.push_back({"pull", "N", Reaction{"s", -1}, "slack", "Slack."});
     },
     "/valid_while/0/reaction/length", "unknown_symbol", "There is no held length 's' in this scene."},
    {"ImpactAtNoEvent",
     [](Scene& s) {
       s.impact = Impact{"strike", {{"l_dot", "-l_dot"}}, ""};
     },
     "/impact/event", "unknown_event", "There is no event 'strike' in this scene."},
    {"ImpactOnAParameter",
     [](Scene& s) {
       s.events.push_back({"floor", "l - l0", Crossing::rising, "", ""});
       s.impact = Impact{"floor", {{"m", "2*m"}}, ""};
     },
     "/impact/map/m", "unknown_symbol", "'m' is neither a coordinate nor a velocity."},
};

class SceneMistake : public testing::TestWithParam<Mistake> {};
INSTANTIATE_TEST_SUITE_P(Table, SceneMistake, testing::ValuesIn(table),
                         [](const auto& info) { return info.param.name; });

TEST_P(SceneMistake, IsFoundAtItsPlaceAndNothingElse) {
  const Mistake& mistake = GetParam();
  Scene scene = test::scene_of("spring_pendulum");
  mistake.make(scene);
  EXPECT_THAT(mistakes_in(scene), ElementsAre(IsDiagnostic(mistake.place, mistake.code, mistake.message)));
}

TEST(SceneMistake, InAUnitSaysWhichUnitsThereAre) {
  Scene scene = test::scene_of("spring_pendulum");
  scene.parameters[2].unit = "cm";
  EXPECT_THAT(mistakes_in(scene),
              Contains(IsDiagnostic(
                  "/parameters/2/unit", "unknown_unit",
                  "The unit 'cm' is not an SI unit without a prefix; write kg, m, s, rad, N, J, ...")));
  scene.parameters[2].unit = "ell";
  EXPECT_THAT(
      mistakes_in(scene),
      Contains(IsDiagnostic("/parameters/2/unit", "unknown_unit",
                            "The unit 'ell' is not known; write a product of SI units such as kg*m/s^2.")));
}

TEST(SceneMistake, OfDefaultsThatGoInACircleIsFoundInEachOfThem) {
  Scene scene = test::scene_of("cart_pendulum");  // M = 2*m
  scene.parameters[1].default_value = "M/2";
  EXPECT_THAT(
      mistakes_in(scene),
      ElementsAre(IsDiagnostic("/parameters/0/default", "cycle", "The default of 'M' depends on itself."),
                  IsDiagnostic("/parameters/1/default", "cycle", "The default of 'm' depends on itself.")));
}

TEST(SceneMistake, DoesNotHideTheOthers) {
  Scene scene = test::scene_of("spring_pendulum");
  scene.parameters[1].default_value = "n";
  scene.points[1].components = {"l + theta", "-l*(cos(theta)"};
  scene.bodies.push_back(Particle{"second", "m", {"nowhere", {}}});
  scene.springs[0].length = "l*theta_dot";
  std::vector<std::string> places;
  for (const Diagnostic& diagnostic : mistakes_in(scene)) places.push_back(diagnostic.place);
  EXPECT_THAT(places, ElementsAre("/parameters/1/default", "/points/1/components/0", "/points/1/components/1",
                                  "/bodies/1/position", "/springs/0/length"));
}

TEST(SceneMistake, AllOfThemAreInTheErrorThatTheModelThrows) {
  Scene scene = test::scene_of("spring_pendulum");
  scene.parameters[1].default_value = "n";
  scene.coordinates.clear();
  try {
    (void)build_model(scene);
    FAIL() << "built";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_scene);
    EXPECT_GE(error.diagnostics().size(), 2u);
    for (const Diagnostic& diagnostic : error.diagnostics())
      EXPECT_THAT(error.what(), testing::HasSubstr(diagnostic.place + ": " + diagnostic.message));
  }
}

TEST(SceneMistake, IsACoordinateWithWhichNothingMoves) {
  Scene scene = test::scene_of("spring_pendulum");
  scene.coordinates.push_back({"phi", "rad", "0", "0", "", {}, "", ""});
  try {
    (void)build_model(scene);
    FAIL() << "built";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.diagnostics(),
                ElementsAre(IsDiagnostic("/coordinates/2", "no_inertia",
                                         "Nothing that has mass moves with 'phi', so its acceleration is "
                                         "undetermined.")));
  }
}

TEST(ParsedScene, OfEverySceneHasNoMistakes) {
  for (const auto* group : {&test::practice_systems(), &test::textbook_systems()}) {
    for (const std::string& name : *group)
      EXPECT_THAT(mistakes_in(test::scene_of(name)), ElementsAre()) << name;
  }
}

TEST(ParsedScene, TakesAPlainNumberForANumberOfSIUnits) {
  Scene scene = test::scene_of("spring_pendulum");
  scene.points[0].components = {"0.5", "2"};
  scene.springs[0].rest_length = "1";
  EXPECT_THAT(mistakes_in(scene), ElementsAre());
}

}  // namespace
}  // namespace qdot::parsed_scene_test
