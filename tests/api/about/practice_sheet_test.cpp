#include "api/about/practice_sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "api/json/json.hpp"
#include "api/service.hpp"

namespace qdot::api::practice_sheet_test {
namespace {

const Service& service() {
  static const Service service;
  return service;
}

Json get(const std::string& target) {
  const Response response = service().handle({.method = "GET", .target = target});
  EXPECT_EQ(response.status, 200) << target;
  return Json::parse(response.body);
}

const Json& part(const Json& exercise, std::size_t i) { return exercise["parts"].at(i); }

TEST(PracticeSheet, ListsTenExercisesWithTheirQuestions) {
  const Json exercises = get("/v1/problems")["problems"];
  ASSERT_EQ(exercises.size(), 10U);
  for (std::size_t i = 0; i < exercises.size(); ++i) {
    EXPECT_EQ(exercises[i]["number"], i + 1);
    EXPECT_EQ(exercises[i]["href"], "/v1/problems/" + std::to_string(i + 1));
    EXPECT_FALSE(exercises[i]["parts"].empty());
  }
}

TEST(PracticeSheet, EveryPartShowsTheRequestAndItsAnswer) {
  std::size_t count = 0;
  const Json list = get("/v1/problems");
  for (const Json& exercise : list["problems"]) {
    const Json answers = get(exercise["href"].get<std::string>());
    for (const Json& part : answers["parts"]) {
      ++count;
      EXPECT_EQ(part["status"], 200) << part["request"];
      const Json& request = part["request"];
      const Response again = service().handle({.method = "POST",
                                               .target = request["path"].get<std::string>(),
                                               .headers = {},
                                               .body = request["body"].dump()});
      EXPECT_EQ(Json::parse(again.body), part["answer"]);
      EXPECT_NE(request["curl"].get<std::string>().find(request["path"].get<std::string>()),
                std::string::npos);
    }
  }
  EXPECT_EQ(count, 18U);
}

/// Closed forms worked out by hand from the positions that the exercises describe.
TEST(PracticeSheet, AnswersHaveTheirClosedForms) {
  const auto result = [](int exercise, std::size_t i, const char* pointer) {
    return part(get("/v1/problems/" + std::to_string(exercise)), i)["result"].at(pointer);
  };
  const auto number = [&](int exercise, std::size_t i, const char* pointer) {
    return result(exercise, i, pointer).get<double>();
  };
  constexpr double g = 9.81;
  EXPECT_NEAR(number(4, 0, "/modes/0/omega"), std::sqrt(g / (2 * 0.4)), 1e-14);
  EXPECT_NEAR(result(4, 0, "/modes/1/shape_scaled")["theta"].get<double>(), -2, 1e-14);
  EXPECT_NEAR(number(5, 0, "/modes/1/lambda"), (17 + std::sqrt(217.0)) / 4, 1e-13);
  EXPECT_NEAR(result(6, 2, "/critical")[0]["value"].get<double>(), std::sqrt(g / 0.5), 1e-13);
  EXPECT_NEAR(number(7, 1, "/phi_max"), std::numbers::pi / 3, 1e-14);
  const double theta = number(8, 0, "/theta_max");
  EXPECT_NEAR(0.125 / std::pow(0.5 + std::sin(theta), 2) - std::cos(theta) + 0.5, 0, 1e-14);
  const double at = std::numbers::pi / 6;
  EXPECT_NEAR(number(10, 1, "/Omega"),
              std::sqrt(3 * g / 0.2 * (15 * std::sin(at) - std::cos(at)) /
                        (53 * std::sin(2 * at) - 9 * std::cos(2 * at))),
              1e-13);
}

TEST(PracticeSheet, WhatIsPickedIsInTheAnswer) {
  for (const Json& exercise : practice_sheet()) {
    const Json answers = get("/v1/problems/" + std::to_string(exercise["number"].get<int>()));
    for (std::size_t i = 0; i < exercise["parts"].size(); ++i) {
      EXPECT_GT(part(answers, i)["result"].size(), 0U);
      EXPECT_EQ(part(answers, i)["result"].size(), exercise["parts"][i]["result"].size())
          << exercise["number"] << " " << part(answers, i)["result"];
    }
  }
}

TEST(PracticeSheet, AgreesEverywhereButInItsTenthExercise) {
  std::size_t compared = 0;
  for (int number = 1; number <= 10; ++number) {
    const Json answers = get("/v1/problems/" + std::to_string(number));
    for (const Json& part : answers["parts"]) {
      const Json& sheet = part["sheet"];
      EXPECT_EQ(sheet.contains("agrees"), !sheet["result"].is_null()) << number;
      if (!sheet.contains("agrees")) continue;
      ++compared;
      EXPECT_EQ(sheet["agrees"], number != 10) << number;
    }
  }
  EXPECT_EQ(compared, 13U);
  EXPECT_NE(part(get("/v1/problems/10"), 0)["sheet"]["erratum"].get<std::string>().find("53/3"),
            std::string::npos);
}

TEST(PracticeSheet, KnowsNoEleventhProblem) {
  for (const char* number : {"0", "11", "x", "01"}) {
    EXPECT_EQ(service().handle({.method = "GET", .target = std::string("/v1/problems/") + number}).status,
              404);
  }
}

}  // namespace
}  // namespace qdot::api::practice_sheet_test
