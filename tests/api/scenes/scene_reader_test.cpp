#include "api/scenes/scene_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "api/contract/json_reader.hpp"
#include "api/json/limits.hpp"
#include "api/scenes/scene_fields.hpp"
#include "tests/support/files.hpp"

namespace qdot::api {
namespace {

/// A scene with something in every field.
const char* const full_scene = R"json({
  "name": "full", "title": "Full", "problem": "11", "model_version": "2.0.0", "description": "Everything.",
  "parameters": [
    {"name": "m", "unit": "kg", "default": 1.5, "domain": "> 0, <= 1e3", "meaning": "mass", "latex": "m"},
    {"name": "l", "unit": "m", "default": "2*a", "domain": "<=-.5"}],
  "coordinates": [
    {"name": "x", "unit": "m", "initial": "l", "initial_rate": -1, "scale": "l", "domain": ">= 0"},
    {"name": "phi", "unit": "rad"}],
  "inputs": [{"name": "F", "unit": "N", "default": "cos(t)"}, {"name": "G", "unit": "N"}],
  "held_lengths": [{"name": "s", "unit": "m", "value": "l"}],
  "points": [{"name": "bob", "components": ["x", 0]}],
  "bodies": [
    {"kind": "particle", "name": "bead", "mass": "m", "position": "bob"},
    {"kind": "rod", "mass": "2*m", "start": "bob", "end": ["x", "l"]},
    {"kind": "disk", "mass": "m", "radius": "l", "centre": "bob", "angle": "phi"}],
  "gravity": [0, "-9.81"],
  "springs": [{"stiffness": "k", "length": "x"}],
  "potential": "V0", "dissipation": "b*x_dot^2/2",
  "forces": [{"name": "push", "vector": ["F", 0], "point": "bob"}],
  "valid_while": [
    {"name": "tension", "unit": "N", "reaction": {"length": "s", "sign": -1}, "reason": "slack", "message": "Slack."},
    {"name": "up", "unit": "1", "expression": "cos(phi)", "reason": "fall", "message": "Fell."}],
  "singular_where": [{"name": "axis", "expression": "x", "message": "On the axis."}],
  "events": [
    {"name": "strike", "expression": "x", "direction": "rising", "when": "phi", "meaning": "strikes"},
    {"name": "pass", "expression": "phi"}],
  "impact": {"event": "strike", "map": {"x": "-x", "phi": 0, "x_dot": "x_dot"}, "meaning": "jumps"},
  "scales": {"mass": "m", "length": "l", "time": 1, "names": {"m": "mu"}},
  "lines": [["bob", "bob"]]
})json";

TEST(SceneReader, EveryFieldArrives) {
  const SceneReading reading = read_scene(Json::parse(full_scene));
  const Scene& scene = reading.scene;
  ASSERT_TRUE(reading.errors.empty()) << reading.errors.front().pointer;
  EXPECT_EQ(scene.name, "full");
  EXPECT_EQ(scene.model_version, "2.0.0");
  EXPECT_EQ(scene.parameters[1].default_value, "2*a");
  EXPECT_EQ(scene.coordinates[0].scale, "l");
  EXPECT_EQ(scene.held_lengths[0].value, "l");
  EXPECT_EQ(std::get<Particle>(scene.bodies[0]).position.point, "bob");
  EXPECT_EQ(std::get<SlenderRod>(scene.bodies[1]).end.components, (std::vector<std::string>{"x", "l"}));
  EXPECT_EQ(std::get<RigidBody>(scene.bodies[2]).angle, "phi");
  EXPECT_EQ(scene.potential, "V0");
  EXPECT_EQ(scene.dissipation, "b*x_dot^2/2");
  EXPECT_EQ(scene.forces[0].vector.size(), 2U);
  EXPECT_EQ(std::get<Reaction>(scene.valid_while[0].quantity).sign, -1);
  EXPECT_EQ(std::get<std::string>(scene.valid_while[1].quantity), "cos(phi)");
  EXPECT_EQ(scene.singular_where[0].expression, "x");
  EXPECT_EQ(scene.events[0].direction, Crossing::rising);
  EXPECT_EQ(scene.events[1].direction, Crossing::either);
  EXPECT_EQ(scene.scales->names.front().second, "mu");
  EXPECT_EQ(scene.lines.front().size(), 2U);
}

TEST(SceneReader, RigidBodiesArriveWithTheirShapesAndTurns) {
  Json json = Json::parse(full_scene);
  json["bodies"] = Json::parse(R"([
    {"kind": "box", "mass": "m", "width": 1, "height": "l", "depth": 2, "centre": ["x", 0, 0],
     "orientation": {"rotations": [{"axis": [0, 1, 1], "angle": "phi"}]}},
    {"kind": "rigid_body", "name": "top", "mass": "m", "principal_moments": ["A", "B", 3], "centre": ["x", 0, 0],
     "orientation": {"sequence": "ZXZ", "angles": ["phi", 0, 0]}}])");
  json["dampers"] = Json::parse(R"([{"coefficient": 1, "law": "quadratic", "between": ["bob", ["x", 1]]}])");
  json["forces"] = Json::parse(R"([{"value": "F", "along": "x"}, {"torque": [0, 0, 1], "body": "top"}])");
  const SceneReading reading = read_scene(json);
  ASSERT_TRUE(reading.errors.empty()) << reading.errors.front().pointer;
  const auto& box = std::get<RigidBody>(reading.scene.bodies[0]);
  EXPECT_EQ(box.shape, "box");
  EXPECT_EQ(box.sizes.at("height"), "l");
  EXPECT_EQ(box.orientation->rotations[0].axis[2], "1");
  EXPECT_EQ(std::get<RigidBody>(reading.scene.bodies[1]).principal_moments[1], "B");
  EXPECT_EQ(std::get<RigidBody>(reading.scene.bodies[1]).orientation->sequence, "ZXZ");
  EXPECT_EQ(reading.scene.dampers[0].law, Damper::Law::quadratic);
  EXPECT_EQ(reading.scene.dampers[0].between[1].components[1], "1");
  EXPECT_EQ(reading.scene.forces[0].along, "x");
  EXPECT_EQ(reading.scene.forces[1].body, "top");
}

TEST(SceneReader, MapsKeepTheirOrder) {
  const Scene scene = read_scene(Json::parse(full_scene)).scene;
  using Pair = std::pair<std::string, std::string>;
  EXPECT_EQ(scene.impact->map, (std::vector<Pair>{{"x", "-x"}, {"phi", "0"}, {"x_dot", "x_dot"}}));
}

TEST(SceneReader, NumbersBecomeTheirShortestText) {
  const Scene scene = read_scene(Json::parse(full_scene)).scene;
  EXPECT_EQ(scene.parameters[0].default_value, "1.5");
  EXPECT_EQ(scene.coordinates[0].initial_rate, "-1");
  EXPECT_EQ(scene.gravity[0], "0");
}

TEST(SceneReader, NumbersKeepTheirDigits) {
  std::string text(full_scene);
  const std::string digits = "1.50000000000000000000000001";
  const std::size_t at = text.find("1.5");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 3, digits);
  const auto document = std::get<JsonDocument>(read_json(text));
  EXPECT_EQ(
      read_scene(document.value, Place::of_document(&document.numbers)).scene.parameters[0].default_value,
      digits);
}

TEST(SceneReader, AbsentExpressionsAreZero) {
  const Scene scene = read_scene(Json::parse(full_scene)).scene;
  EXPECT_EQ(scene.coordinates[1].initial, "0");
  EXPECT_EQ(scene.coordinates[1].initial_rate, "0");
  EXPECT_EQ(scene.inputs[1].default_value, "0");
  EXPECT_EQ(scene.springs[0].rest_length, "0");
}

TEST(SceneReader, DomainsOpenAndClose) {
  const Scene scene = read_scene(Json::parse(full_scene)).scene;
  const Domain mass = scene.parameters[0].domain;
  EXPECT_FALSE(mass.contains(0));
  EXPECT_TRUE(mass.contains(1000));
  EXPECT_FALSE(mass.contains(1000.5));
  EXPECT_TRUE(scene.parameters[1].domain.contains(-0.5));
  EXPECT_FALSE(scene.parameters[1].domain.contains(-0.4));
  EXPECT_TRUE(scene.coordinates[0].domain.contains(0));
  EXPECT_TRUE(scene.coordinates[1].domain.contains(-1e300));
}

TEST(SceneReader, ADomainWithoutNumbersIsRefused) {
  for (const char* text :
       {"> 1, < 0", "> 0, < 0", ">= 0, < 0", "> 0, > 1", "", ",", "> 0,", ">", "> 1e999", "> 0 m"}) {
    Json json = Json::parse(full_scene);
    json["parameters"][0]["domain"] = text;
    const auto errors = read_scene(json).errors;
    ASSERT_EQ(errors.size(), 1U) << text;
    EXPECT_EQ(errors[0].code, "domain");
    EXPECT_EQ(errors[0].pointer, "#/parameters/0/domain");
  }
}

TEST(SceneReader, RefusesEveryMistakeAtItsPlace) {
  const Json table = test::json_file("tests/api/scenes/scene_mistakes.json");
  ASSERT_TRUE(read_scene(table["scene"]).errors.empty());
  for (const Json& mistake : table["mistakes"]) {
    Json scene = table["scene"];
    scene.merge_patch(mistake["change"]);
    const auto errors = read_scene(scene).errors;
    ASSERT_EQ(errors.size(), 1U) << mistake["fact"];
    EXPECT_EQ(errors[0].code, mistake["code"]) << mistake["fact"];
    EXPECT_EQ(errors[0].pointer, "#" + mistake["place"].get<std::string>()) << mistake["fact"];
    EXPECT_FALSE(errors[0].detail.empty());
  }
}

TEST(SceneReader, ReportsAllMistakesAtOnce) {
  const auto errors = read_scene(Json::parse(R"({
    "name": "a b", "titel": "A", "coordinates": [{"name": "t", "unit": 1}],
    "bodies": [{"kind": "particle", "position": ["x", null]}]})"))
                          .errors;
  std::vector<std::string> places;
  for (const FieldError& error : errors) places.push_back(error.pointer);
  std::sort(places.begin(), places.end());
  EXPECT_EQ(places, (std::vector<std::string>{"#/bodies/0", "#/bodies/0/position/1", "#/coordinates/0/name",
                                              "#/coordinates/0/unit", "#/name", "#/titel"}));
}

TEST(SceneReader, MessagesSayWhatToWriteInstead) {
  const auto errors = read_scene(Json::parse(R"({
    "name": "a", "titel": "A", "coordinates": [{"name": "x", "unit": "m", "color": "red"}],
    "bodies": [{"kind": "dsik"}, {"kind": "particle", "mass": null, "position": ["x", 0]}]})"))
                          .errors;
  ASSERT_EQ(errors.size(), 4U);
  EXPECT_EQ(errors[0].detail, "There is no field 'titel'.");
  EXPECT_EQ(errors[0].did_you_mean, "title");
  EXPECT_EQ(errors[1].allowed, (std::vector<std::string>{"name", "unit", "initial", "initial_rate", "scale",
                                                         "domain", "meaning", "latex"}));
  EXPECT_EQ(errors[2].detail, "'kind' cannot be 'dsik'.");
  EXPECT_EQ(errors[2].did_you_mean, "disk");
  EXPECT_EQ(errors[3].detail,
            "'mass' needs an expression, such as \"-l*cos(theta)\", not null; leave out what has no value.");
}

TEST(SceneReader, SizesAreBounded) {
  Json json = Json::parse(full_scene);
  json["coordinates"][1]["initial"] = std::string(limits::expression_bytes + 1, '1');
  json["parameters"] = Json::array();
  for (std::size_t i = 0; i <= scene_limits::parameters; ++i) {
    json["parameters"].push_back({{"name", "p" + std::to_string(i)}, {"unit", "1"}, {"default", 0}});
  }
  const auto errors = read_scene(json).errors;
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(errors[0].detail, "'parameters' has 33 entries; at most 32 are read.");
  EXPECT_EQ(errors[1].pointer, "#/coordinates/1/initial");
}

TEST(SceneReader, AnswersStaySmallWhateverIsSent) {
  Json json = Json::parse(full_scene);
  for (int i = 0; i < 1000; ++i) json["field" + std::to_string(i)] = i;
  EXPECT_EQ(read_scene(json).errors.size(), limits::listed_errors + 1) << "one more says that there are more";

  json = Json::parse(full_scene);
  json[std::string(10'000, 'x')] = 1;
  const auto errors = read_scene(json).errors;
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].pointer, "#") << "an overlong name is reported at its object";
  EXPECT_LT(errors[0].detail.size(), 400U);
}

TEST(SceneReader, NoSceneAtAllIsAMistakeToo) {
  for (const char* text : {"null", "[]", "1", "\"scene\""}) {
    const auto errors = read_scene(Json::parse(text)).errors;
    ASSERT_EQ(errors.size(), 1U) << text;
    EXPECT_EQ(errors[0].code, "wrong_type");
  }
}

}  // namespace
}  // namespace qdot::api
