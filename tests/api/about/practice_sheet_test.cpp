#include "api/about/practice_sheet.hpp"

#include <gtest/gtest.h>

#include "api/json/json.hpp"
#include "api/service.hpp"

namespace qdot::api {
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

const Json& part(const Json& problem, std::size_t i) { return problem["parts"].at(i); }

TEST(Practice, ListsTenProblemsWithTheirQuestions) {
  const Json problems = get("/v1/problems")["problems"];
  ASSERT_EQ(problems.size(), 10U);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    EXPECT_EQ(problems[i]["number"], i + 1);
    EXPECT_EQ(problems[i]["href"], "/v1/problems/" + std::to_string(i + 1));
    EXPECT_FALSE(problems[i]["parts"].empty());
  }
}

TEST(Practice, EveryPartIsAnsweredByItsRequest) {
  const Json list = get("/v1/problems");
  for (const Json& problem : list["problems"]) {
    const Json answers = get(problem["href"].get<std::string>());
    for (const Json& part : answers["parts"]) {
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
}

TEST(Practice, WhatIsPickedIsInTheAnswer) {
  for (const Json& problem : practice_sheet()) {
    const Json answers = get("/v1/problems/" + std::to_string(problem["number"].get<int>()));
    for (std::size_t i = 0; i < problem["parts"].size(); ++i) {
      EXPECT_EQ(part(answers, i)["result"].size(), problem["parts"][i]["result"].size())
          << problem["number"] << " " << part(answers, i)["result"];
    }
  }
}

TEST(Practice, ShowsWhereTheSheetIsWrong) {
  EXPECT_EQ(part(get("/v1/problems/10"), 0)["sheet"]["agrees"], false);
  EXPECT_NE(part(get("/v1/problems/10"), 0)["sheet"]["erratum"].get<std::string>().find("53/3"),
            std::string::npos);
}

TEST(Practice, KnowsNoEleventhProblem) {
  for (const char* number : {"0", "11", "x", "01"}) {
    EXPECT_EQ(service().handle({.method = "GET", .target = std::string("/v1/problems/") + number}).status,
              404);
  }
}

}  // namespace
}  // namespace qdot::api
