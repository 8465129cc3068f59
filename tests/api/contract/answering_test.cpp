#include "api/contract/answering.hpp"

#include <gtest/gtest.h>

#include "api/answers/energy/request.hpp"
#include "tests/api/example_systems.hpp"

namespace qdot::api {
namespace {

/// A handler that answers with the echo.
Response ask(const Request& request) {
  const Handler handler = handler_of(answering<EnergyRequest>(
      energy_table(), find_example,
      [](const Resolved<EnergyRequest>& read, Call& call) { return json_response(read.echo, call.layout); }));
  Call call{.request = request, .target = parse_target(request.target).value()};
  return handler(call);
}

Response post(std::string body, std::map<std::string, std::string> headers = {}, std::string query = "") {
  return ask({.method = "POST",
              .target = "/v1/energy" + query,
              .headers = std::move(headers),
              .body = std::move(body)});
}

Json errors(const Response& response) { return Json::parse(response.body)["errors"]; }

TEST(Answering, TwoRoadsOfOneQuestion) {
  const Response got = ask({.method = "GET", .target = "/v1/energy?system=spring_pendulum&theta=30deg&t=2"});
  EXPECT_EQ(got.status, 200) << got.body;
  EXPECT_EQ(got.body, post(R"({"system": "spring_pendulum", "initial": {"theta": "30deg"}, "t": 2})").body);
}

TEST(Answering, TakesWhatPlainCurlSends) {
  const std::string body = R"({"system": "spring_pendulum"})";
  EXPECT_EQ(post(body, {{"content-type", "application/x-www-form-urlencoded"}}).status, 200);
  EXPECT_EQ(post(body, {{"content-type", "application/json"}}).status, 200);
  const Response refused =
      post("system=spring_pendulum", {{"content-type", "application/x-www-form-urlencoded"}});
  EXPECT_EQ(refused.status, 415);
  EXPECT_EQ(refused.content_type, "application/problem+json");
}

TEST(Answering, SaysWhatIsWrongInTheWordsOfTheRoad) {
  EXPECT_EQ(post("{").status, 400);
  EXPECT_EQ(post(std::string(70'000, ' ')).status, 413);
  EXPECT_EQ(post(R"({"system": [[[[[[[[[[[[[[[[[0]]]]]]]]]]]]]]]]]})").status, 422);
  const Response posted = post(R"({"system": "spring_pendulum", "parameters": {"kk": 1}})");
  EXPECT_EQ(posted.status, 422);
  EXPECT_EQ(errors(posted)[0]["pointer"], "#/parameters/kk");
  EXPECT_EQ(errors(posted)[0]["allowed"], (Json{"m", "k", "Omega", "dt"}));
  const Response gotten = ask({.method = "GET", .target = "/v1/energy?system=spring_pendulum&kk=1"});
  EXPECT_EQ(errors(gotten)[0]["parameter"], "kk");
  EXPECT_FALSE(errors(gotten)[0].contains("pointer"));
}

TEST(Answering, APostSaysEverythingButTheFormatInItsBody) {
  const Response wrong = post(R"({"system": "spring_pendulum"})", {}, "?t=1&format=csv");
  EXPECT_EQ(wrong.status, 422);
  EXPECT_EQ(errors(wrong)[0]["parameter"], "t");
  EXPECT_EQ(errors(wrong)[1]["pointer"], "#/format");  // energies come as JSON only
}

}  // namespace
}  // namespace qdot::api
