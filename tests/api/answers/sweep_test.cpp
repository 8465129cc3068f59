#include <gtest/gtest.h>

#include "api/answers/endpoints.hpp"
#include "api/answers/sweep/schema_place.hpp"
#include "api/answers/sweep/variables.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {
namespace {

std::string refusal(const std::string& endpoint, const std::string& pointer) {
  const Json schema = description_of(*endpoint_at("/v1/" + endpoint)).at("schema");
  const auto error = place_in_schema(schema, pointer, Place(Road::body));
  return error ? error->code : "";
}

TEST(PlaceInSchema, IsWhereAnswersMayHaveAValue) {
  for (const char* pointer :
       {"/modes/0/omega", "/modes/11/shape/theta", "/equilibrium/state/x", "/units/omega"})
    EXPECT_EQ(refusal("modes", pointer), "") << pointer;
  for (const char* pointer : {"/theta_max", "/phi_min_deg", "/period", "/constants/E", "/error/theta_max"})
    EXPECT_EQ(refusal("turning_points", pointer), "") << pointer;
  EXPECT_EQ(refusal("energy", "/p_theta"), "");
}

TEST(PlaceInSchema, IsNotWhereTheyNeverHaveAny) {
  for (const char* pointer : {"/mode/0/omega", "/modes/omega", "/modes/0/omegas", "/modes/0/omega/0", "/"})
    EXPECT_EQ(refusal("modes", pointer), "unknown_place") << pointer;
  EXPECT_EQ(refusal("turning_points", "/theta_mx"), "unknown_place");
  EXPECT_EQ(refusal("modes", "/modes"), "wrong_place");
  for (const char* pointer : {"", "modes", "/modes/*/omega", "/a~2"})
    EXPECT_EQ(refusal("modes", pointer), "syntax") << pointer;
}

std::optional<SweptValues> read(const SweepRequest& request, Errors& errors) {
  static const Catalogue catalogue = Catalogue::built_in();
  const Place whole(Road::body);
  const Scene& scene = catalogue.find("spring_pendulum")->scene;
  const Json parameters{{"m", 2}, {"l0", "20 cm"}};
  const Place of_parameters = whole.below("parameters");
  ParameterScope scope(scene, parameters, of_parameters);
  return read_variables(request, scene, *endpoint_at("/v1/energy")->question.fields, whole, scope, 1000,
                        errors);
}

TEST(SweptValues, OfAGridAreEveryCombinationInOrder) {
  Errors errors;
  const auto swept = read(
      {.vary = {{"k", {{"values", {1, 2}}}}, {"theta", {{"from", 0}, {"to", 1}, {"count", 3}}}}}, errors);
  ASSERT_TRUE(swept);
  EXPECT_EQ(swept->rows, 6U);
  EXPECT_EQ(swept->values, (std::vector<double>{1, 0, 1, 0.5, 1, 1, 2, 0, 2, 0.5, 2, 1}));
}

TEST(SweptValues, AreQuantitiesAndExpressionsOfTheQuestionsParameters) {
  Errors errors;
  const auto swept = read({.vary = {{"k", {{"values", {"m*g/l0", "5 N/cm", 3}}}},
                                    {"theta", {{"from", "-30deg"}, {"to", "pi/6"}, {"count", 2}}}}},
                          errors);
  ASSERT_TRUE(swept);
  const double angle = 0.5235987755982989;  // rounded from pi/6, once
  EXPECT_EQ(swept->values,
            (std::vector<double>{98.1, -angle, 98.1, angle, 500, -angle, 500, angle, 3, -angle, 3, angle}));
}

TEST(SweptValues, SpeakOfNothingThatVaries) {
  Errors errors;
  EXPECT_FALSE(read({.vary = {{"g", {{"values", {1}}}}, {"k", {{"values", {"m*g/l0"}}}}}}, errors));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].code, "varies");
  EXPECT_EQ(errors[0].pointer, "#/vary/k/values/0");
}

TEST(SweptValues, SayHowTurnsAreRead) {
  Errors errors;
  const auto swept = read({.vary = {{"theta_dot", {{"values", {"1 Hz", "2 Hz"}}}}}}, errors);
  ASSERT_TRUE(swept);
  ASSERT_EQ(swept->notes.size(), 2U);
  EXPECT_NE(swept->notes[0].find("1 Hz' counts turns"), std::string::npos) << swept->notes[0];
  EXPECT_NE(swept->notes[1].find("1 Hz' is rounded"), std::string::npos) << swept->notes[1];
}

TEST(SweptValues, AreNeverMoreThanAllowed) {
  Errors errors;
  const Json grid{{"from", 1}, {"to", 2}, {"count", 32}};
  EXPECT_FALSE(read({.vary = {{"k", grid}, {"m", grid}}}, errors));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].code, "too_many");
  Errors none;
  EXPECT_FALSE(read({.vary = {{"k", {{"from", 1}, {"to", 2}, {"count", 1'000'000'000}}}}}, none));
}

}  // namespace
}  // namespace qdot::api
