#include "api/http/problem.hpp"

#include <gtest/gtest.h>

#include <set>

#include "api/json/limits.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

TEST(Problems, HaveTheFormOfRfc9457) {
  const Problem problem = invalid_request({{.pointer = "#/parameters/kk",
                                            .code = "unknown_field",
                                            .detail = "spring_pendulum has no parameter 'kk'.",
                                            .did_you_mean = "k",
                                            .allowed = {"m", "k"}}});
  const Response response = to_response(problem, "/v1/simulate");
  EXPECT_EQ(response.status, 422);
  EXPECT_EQ(response.content_type, "application/problem+json");
  EXPECT_EQ(
      response.body,
      R"({"type":"/errors/invalid-request","title":"The request does not fit the schema","status":422,)"
      R"("detail":"1 field is wrong.","instance":"/v1/simulate","errors":[{"pointer":"#/parameters/kk",)"
      R"("code":"unknown_field","detail":"spring_pendulum has no parameter 'kk'.","did_you_mean":"k",)"
      R"("allowed":["m","k"]}]})"
      "\n");
}

TEST(Problems, CarryTheirOwnMembers) {
  const Problem problem{.kind = ProblemKind::integration_failed,
                        .detail = "The mass matrix became singular.",
                        .members = {{"reason", "singular-mass"}, {"t_reached", 1.5}}};
  const Json body = Json::parse(to_response(problem, "/v1/simulate").body);
  EXPECT_EQ(body["type"], "/errors/integration-failed");
  EXPECT_EQ(body["reason"], "singular-mass");
  EXPECT_EQ(body["t_reached"], 1.5);
}

TEST(Problems, AreKnownByUniqueNamesWithExplanations) {
  std::set<std::string_view> names;
  for (const ProblemType& type : problem_types()) {
    EXPECT_TRUE(names.insert(type.name).second) << type.name;
    EXPECT_GE(type.status, 400);
    EXPECT_FALSE(type.explanation.empty());
    EXPECT_EQ(find_problem_type(type.name), &type);
    EXPECT_EQ(&problem_type(type.kind), &type);
    EXPECT_EQ(to_response({.kind = type.kind}, "/").status, type.status);
  }
  EXPECT_EQ(find_problem_type("nothing"), nullptr);
}

TEST(Problems, ListSoManyErrorsAndNoMore) {
  const Problem problem = invalid_request(std::vector<FieldError>(700, FieldError{.pointer = "#/x"}));
  EXPECT_EQ(problem.errors.size(), limits::listed_errors);
  EXPECT_EQ(problem.detail, "More than 50 fields are wrong; the first 50 are listed.");
}

TEST(Problems, RepeatLittleOfTheAddress) {
  const Json body =
      Json::parse(to_response({.kind = ProblemKind::not_found}, "/" + std::string(5000, 'x')).body);
  EXPECT_LE(body["instance"].get<std::string>().size(), 103U);
}

TEST(Text, IsPrintableUtf8WhateverWasSent) {
  EXPECT_EQ(in_quotes("k\xC3\xA4se"), "'k\xC3\xA4se'");
  EXPECT_EQ(printable("a\nb\x7F"),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
  EXPECT_EQ(printable("\xFF\xC0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(printable("\xED\xA0\x80", 9), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // a surrogate
  EXPECT_EQ(printable("\xE2\x82"), "\xEF\xBF\xBD\xEF\xBF\xBD");                     // cut off
  EXPECT_EQ(printable(std::string(50, 'x')), std::string(40, 'x') + "...");
  EXPECT_EQ(printable("\xC3\xA4\xC3\xA4", 3), "\xC3\xA4...");
}

TEST(Text, IsTrimmedOfBlanks) {
  EXPECT_EQ(trimmed(" \ta b "), "a b");
  EXPECT_EQ(trimmed("  "), "");
  EXPECT_EQ(lower_case("Application/JSON"), "application/json");
}

}  // namespace
}  // namespace qdot::api
