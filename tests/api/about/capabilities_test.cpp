// What a system says that it can be asked, asked.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/about/capabilities.hpp"
#include "api/json/writer.hpp"
#include "api/service.hpp"

namespace qdot::api {
namespace {

using testing::Contains;
using testing::Not;

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

TEST(Capabilities, EveryExampleIsAnswered) {
  const Json systems = Json::parse(service().handle({.method = "GET", .target = "/v1/systems"}).body);
  for (const Json& system : systems["systems"]) {
    const Json described = description(system["name"]);
    for (const Json& example : described["examples"]) {
      const Response response = service().handle({.method = example["method"],
                                                  .target = example["path"],
                                                  .headers = {{"content-type", "application/json"}},
                                                  .body = to_text(example["body"])});
      EXPECT_EQ(response.status, 200) << example;
    }
  }
}

TEST(Capabilities, AreThoseOfTheSystem) {
  EXPECT_THAT(capabilities("compass_walker"), Contains("gait"));
  EXPECT_THAT(capabilities("cart_pendulum"), Not(Contains("gait")));
  EXPECT_THAT(capabilities("cart_pendulum"), Contains("modes"));
  EXPECT_THAT(capabilities("rolling_disk_platform"), Not(Contains("modes"))) << "it rests nowhere";
}

TEST(Capabilities, NameTheColumnsOfATrajectory) {
  const Json outputs = description("rod_pendulum")["outputs"];
  EXPECT_THAT(outputs, Contains(Json{{"name", "tension"}, {"unit", "N"}}));
  EXPECT_THAT(outputs, Contains(Json{{"name", "p_phi"}, {"unit", "kg*m^2/s"}}));
}

}  // namespace
}  // namespace qdot::api
