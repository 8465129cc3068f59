// What a system says that it can be asked, asked.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/about/capabilities.hpp"
#include "api/answers/endpoints.hpp"
#include "api/json/writer.hpp"
#include "api/service.hpp"

namespace qdot::api {
namespace {

using testing::Contains;

const Service& service() {
  static const Service it;
  return it;
}

Json description(const std::string& system) {
  return Json::parse(service().handle({.method = "GET", .target = "/v1/systems/" + system}).body);
}

std::vector<std::string> capabilities(const std::string& system) {
  return description(system)["capabilities"];
}

const std::vector<std::string> all_systems{
    "spring_pendulum",    "forced_spring_pendulum", "rolling_disk_platform", "cart_pendulum",
    "rod_pendulum",       "rod_spring_pendulum",    "whirling_pendulum",     "orbiting_pendulum",
    "free_spin_pendulum", "compass_walker",         "rotating_l_bar"};

TEST(Capabilities, EveryExampleIsAnswered) {
  std::size_t count = 0;
  for (const std::string& system : all_systems) {
    const Json described = description(system);
    EXPECT_EQ(described["examples"].size(), described["capabilities"].size());
    for (const Json& example : described["examples"]) {
      ++count;
      EXPECT_EQ(example["body"]["system"], system);
      const Response response = service().handle({.method = example["method"],
                                                  .target = example["path"],
                                                  .headers = {{"content-type", "application/json"}},
                                                  .body = to_text(example["body"])});
      EXPECT_EQ(response.status, 200) << example;
    }
  }
  EXPECT_GE(count, 80U);
}

/// Every question applies to every system, except these: only the walker walks. The disk on its platform
/// rests nowhere, whatever its parameters: it is driven outwards.
TEST(Capabilities, AreThoseOfTheSystem) {
  for (const std::string& system : all_systems) {
    std::vector<std::string> expected;
    for (const Endpoint& endpoint : endpoints()) expected.emplace_back(endpoint.name);
    for (const char* about_none : {"check", "sweep", "batch"}) std::erase(expected, about_none);
    if (system != "compass_walker") std::erase(expected, "gait");
    if (system == "rolling_disk_platform") {
      for (const char* about_rest : {"modes", "equilibria", "bifurcations"}) std::erase(expected, about_rest);
    }
    EXPECT_EQ(capabilities(system), expected) << system;
  }
}

TEST(Capabilities, NameTheColumnsOfATrajectory) {
  const Json outputs = description("rod_pendulum")["outputs"];
  EXPECT_THAT(outputs, Contains(Json{{"name", "tension"}, {"unit", "N"}}));
  EXPECT_THAT(outputs, Contains(Json{{"name", "p_phi"}, {"unit", "kg*m^2/s"}}));
}

}  // namespace
}  // namespace qdot::api
