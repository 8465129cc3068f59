#include <gtest/gtest.h>

#include <cmath>

#include "api/answers/endpoints.hpp"
#include "api/answers/sweep/schema_place.hpp"
#include "api/answers/sweep/variables.hpp"
#include "api/scenes/catalogue.hpp"
#include "core/base/work.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/random_bits.hpp"

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
  for (const char* pointer : {"/modes/01/omega", "/modes/18446744073709551615/omega", "/request/initial/00"})
    EXPECT_EQ(refusal("modes", pointer), "unknown_place") << pointer;
  EXPECT_EQ(refusal("modes", "/modes"), "wrong_place");
  for (const char* pointer : {"", "modes", "/modes/*/omega", "/a~2"})
    EXPECT_EQ(refusal("modes", pointer), "syntax") << pointer;
}

/// Row by row.
std::vector<double> values_of(const SweptValues& swept) {
  std::vector<double> values;
  for (std::size_t row = 0; row < swept.rows; ++row)
    for (std::size_t i = 0; i < swept.variables.size(); ++i) values.push_back(swept.value(row, i));
  return values;
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
  EXPECT_EQ(values_of(*swept), (std::vector<double>{1, 0, 1, 0.5, 1, 1, 2, 0, 2, 0.5, 2, 1}));
}

TEST(SweptValues, AreQuantitiesAndExpressionsOfTheQuestionsParameters) {
  Errors errors;
  const auto swept = read({.vary = {{"k", {{"values", {"m*g/l0", "5 N/cm", 3}}}},
                                    {"theta", {{"from", "-30deg"}, {"to", "pi/6"}, {"count", 2}}}}},
                          errors);
  ASSERT_TRUE(swept);
  const double angle = 0.5235987755982989;  // rounded from pi/6, once
  EXPECT_EQ(values_of(*swept),
            (std::vector<double>{98.1, -angle, 98.1, angle, 500, -angle, 500, angle, 3, -angle, 3, angle}));
}

TEST(SweptValues, OfASampleAreDrawnInOrderFromOneSequence) {
  Errors errors;
  const auto swept = read(
      {.vary = {{"k", {{"normal", {10, 2}}}}, {"theta", {{"uniform", {0, 1}}}}}, .count = 100, .seed = 7},
      errors);
  ASSERT_TRUE(swept);
  RandomBits random(7);
  for (std::size_t row = 0; row < 100; ++row) {
    const double radius = std::sqrt(-2 * std::log(1 - random.fraction()));
    EXPECT_NEAR(swept->value(row, 0), 10 + 2 * radius * std::cos(2 * pi * random.fraction()), 1e-13);
    EXPECT_EQ(swept->value(row, 1), random.fraction());
  }
}

TEST(SweptValues, ThatMayPassDoublePrecisionAreLookedAtUntilNobodyWaits) {
  const SweepRequest request{.vary = {{"theta", {{"normal", {1.7e308, 1e307}}}}}, .count = 1000};
  Errors errors;
  EXPECT_FALSE(read(request, errors));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].code, "out_of_range");
  const WorkScope scope(1000, [] { return true; });
  EXPECT_THROW(read(request, errors), Interrupted);
}

TEST(SweptValues, LieBetweenEndsThatAreFurtherApartThanDoublesReach) {
  Errors errors;
  const auto grid = read({.vary = {{"theta", {{"from", -1e308}, {"to", 1e308}, {"count", 5}}}}}, errors);
  ASSERT_TRUE(grid);
  EXPECT_EQ(values_of(*grid), (std::vector<double>{-1e308, -5e307, 0, 5e307, 1e308}));
  const auto sample = read({.vary = {{"theta", {{"uniform", {-1e308, 1.7e308}}}}}, .count = 100}, errors);
  ASSERT_TRUE(sample);
  for (const double value : values_of(*sample)) EXPECT_TRUE(value >= -1e308 && value < 1.7e308) << value;
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
