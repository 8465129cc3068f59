#include "api/service.hpp"
#include "api/contract/version.hpp"

#include <gtest/gtest.h>

#include "api/http/problem.hpp"
#include "api/json/json.hpp"

namespace qdot::api {
namespace {

const Service& service() {
  static const Service service;
  return service;
}

Response get(const std::string& target, const std::map<std::string, std::string>& headers = {}) {
  return service().handle({.method = "GET", .target = target, .headers = headers});
}

Response send(const std::string& method, const std::string& target) {
  return service().handle({.method = method, .target = target});
}

TEST(Service, IsHealthy) {
  const Response response = get("/healthz");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.content_type, "application/json");
  EXPECT_EQ(response.body, "{\"status\":\"ok\"}\n");
}

TEST(Service, HasAnIndexWithExamples) {
  const Json index = Json::parse(get("/").body);
  EXPECT_EQ(index["service_version"], service_version());
  EXPECT_EQ(index["endpoints"]["/healthz"], Json{"GET"});
  ASSERT_EQ(index["examples"].size(), 2U);
  // The first works as it is printed: curl 'localhost:8080/v1/simulate?...'
  const auto example = index["examples"][0].get<std::string>();
  const std::size_t start = example.find("/v1/");
  EXPECT_EQ(get(example.substr(start, example.rfind('\'') - start)).status, 200) << example;
}

TEST(Service, ListsAndDescribesItsSystems) {
  const Json systems = Json::parse(get("/v1/systems").body)["systems"];
  ASSERT_GE(systems.size(), 11U);
  EXPECT_EQ(systems[0]["name"], "spring_pendulum");
  for (const Json& system : systems) {
    const Response response = get(system["href"].get<std::string>());
    ASSERT_EQ(response.status, 200) << system["href"];
    EXPECT_EQ(Json::parse(response.body)["name"], system["name"]);
    EXPECT_FALSE(Json::parse(response.body)["coordinates"].empty());
  }
  const Json pendulum = Json::parse(get("/v1/systems/spring_pendulum").body);
  EXPECT_EQ(pendulum["coordinates"][0]["velocity"]["name"], "l_dot");
  EXPECT_EQ(pendulum["coordinates"][0]["velocity"]["unit"], "m/s");
  EXPECT_EQ(pendulum["parameters"][0]["domain"], (Json{{"exclusiveMinimum", 0.0}}));
}

TEST(Service, ExplainsItsProblems) {
  for (const ProblemType& type : problem_types()) {
    const Response response = get("/errors/" + std::string(type.name));
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(Json::parse(response.body)["status"], type.status);
  }
  EXPECT_EQ(get("/errors/none").status, 404);
}

struct ErrorCase {
  Request request;
  int status;
  std::string type;
};

void PrintTo(const ErrorCase& error, std::ostream* out) {
  *out << error.request.method << ' ' << error.request.target << ' ' << error.request.body.substr(0, 60);
}

Request post(std::string body, const std::string& content_type = "application/json") {
  return {.method = "POST",
          .target = "/v1/simulate",
          .headers = {{"content-type", content_type}},
          .body = std::move(body)};
}

class ServiceErrors : public testing::TestWithParam<ErrorCase> {};

TEST_P(ServiceErrors, AreProblems) {
  const auto& [request, status, type] = GetParam();
  const Response response = service().handle(request);
  EXPECT_EQ(response.status, status) << response.body;
  EXPECT_EQ(response.content_type, "application/problem+json");
  const Json body = Json::parse(response.body);
  EXPECT_EQ(body["type"], "/errors/" + type);
  EXPECT_EQ(body["status"], status);
  EXPECT_FALSE(body["detail"].get<std::string>().empty());
  EXPECT_TRUE(response.body.ends_with("\n"));
  EXPECT_LT(response.body.size(), 2000U);
}

INSTANTIATE_TEST_SUITE_P(
    Service, ServiceErrors,
    testing::Values(
        ErrorCase{{.method = "GET", .target = "/nothing"}, 404, "not-found"},
        ErrorCase{{.method = "GET", .target = "/" + std::string(3000, 'x')}, 404, "not-found"},
        ErrorCase{{.method = "GET", .target = "/v1/systems/nothing"}, 404, "not-found"},
        ErrorCase{{.method = "GET", .target = "/%zz"}, 400, "invalid-target"},
        ErrorCase{{.method = "GET"}, 404, "not-found"},
        ErrorCase{{.method = "POST", .target = "/healthz"}, 405, "method-not-allowed"},
        ErrorCase{{.method = "BREW", .target = "/healthz"}, 405, "method-not-allowed"},
        ErrorCase{{.method = "GET", .target = "/v1/systems", .headers = {{"accept", "text/csv"}}},
                  406,
                  "not-acceptable"},
        ErrorCase{post(""), 400, "invalid-json"}, ErrorCase{post("{\"t_end\": 1e999}"), 400, "invalid-json"},
        ErrorCase{post(std::string(70'000, '1')), 413, "payload-too-large"},
        ErrorCase{post("{}", "text/plain"), 415, "unsupported-media-type"},
        ErrorCase{post(std::string(40, '[')), 422, "limit-exceeded"},
        ErrorCase{post("{}"), 422, "invalid-request"},
        ErrorCase{post("{\"system\": \"" + std::string(60'000, 'x') + "\"}"), 422, "invalid-request"},
        ErrorCase{
            {.method = "GET", .target = "/v1/energy?system=spring_pendulum&kk=1"}, 422, "invalid-request"}));

constexpr std::string_view question = "/v1/simulate?system=spring_pendulum&theta=30deg&t_end=1&samples=3";

TEST(Service, TwoRoadsOfOneMotion) {
  const Response got = get(std::string(question));
  const Response posted = service().handle(
      post(R"({"system": "spring_pendulum", "initial": {"theta": "30deg"}, "t_end": 1, "samples": 3})",
           "application/x-www-form-urlencoded"));
  EXPECT_EQ(got.status, 200);
  EXPECT_EQ(got.body, posted.body);
  EXPECT_EQ(Json::parse(got.body)["trajectory"]["t"], (Json{0.0, 0.5, 1.0}));
}

TEST(Service, AnswersItsOwnEchoWithTheSameBody) {
  const Response first = get(std::string(question));
  const Json echo = Json::parse(first.body)["request"];
  EXPECT_EQ(service().handle(post(echo.dump())).body, first.body);
}

TEST(Service, WritesTrajectoriesAsCsvWhenAsked) {
  const Response by_header = get(std::string(question), {{"accept", "text/csv"}});
  EXPECT_TRUE(by_header.content_type.starts_with("text/csv")) << by_header.body;
  EXPECT_TRUE(by_header.body.starts_with("t,l,theta,")) << by_header.body;
  EXPECT_EQ(get(std::string(question) + "&format=csv").body, by_header.body);
  EXPECT_EQ(get(std::string(question) + "&format=json", {{"accept", "text/csv"}}).content_type,
            "application/json");
}

TEST(Service, TellsItsTimeInAHeaderOnly) {
  const Response response = get(std::string(question));
  const std::string timing = response.headers.at("Server-Timing");
  for (const char* part : {"parse;dur=", "solve;dur=", "encode;dur="}) {
    EXPECT_NE(timing.find(part), std::string::npos) << timing;
  }
}

TEST(Service, NamesTheAllowedMethods) {
  EXPECT_EQ(send("DELETE", "/v1/systems").headers.at("Allow"), "GET, HEAD, OPTIONS");
  const Response options = send("OPTIONS", "/v1/systems");
  EXPECT_EQ(options.status, 204);
  EXPECT_EQ(options.headers.at("Allow"), "GET, HEAD, OPTIONS");
  EXPECT_EQ(send("OPTIONS", "*").status, 204);
}

TEST(Service, SendsOnlyWhatIsAccepted) {
  EXPECT_EQ(get("/v1/systems", {{"accept", "application/json"}}).status, 200);
  const Response refused = get("/v1/systems", {{"accept", "text/csv"}});
  EXPECT_EQ(refused.status, 406);
  EXPECT_EQ(refused.content_type, "application/problem+json");
}

TEST(Service, IndentsWhenAsked) {
  EXPECT_EQ(get("/healthz?pretty").body, "{\n  \"status\": \"ok\"\n}\n");
  EXPECT_EQ(get("/healthz?pretty=false").body, get("/healthz").body);
  EXPECT_TRUE(get("/nothing?pretty").body.starts_with("{\n"));
}

TEST(Service, AnswersAKnownEntityTagWithoutTheBody) {
  const Response first = get("/v1/systems");
  const std::string tag = first.headers.at("ETag");
  const Response second = get("/v1/systems", {{"if-none-match", tag}});
  EXPECT_EQ(second.status, 304);
  EXPECT_EQ(second.body, "");
  EXPECT_EQ(second.headers.at("ETag"), tag);
  EXPECT_NE(get("/v1/systems?pretty").headers.at("ETag"), tag);
}

TEST(Service, AnswersHeadAsGet) {
  const Response head = send("HEAD", "/healthz");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.body, get("/healthz").body);  // the transport sends its length and not the body
}

TEST(Service, GivesTheSameBytesForTheSameRequest) {
  const Service other;
  for (const char* target : {"/", "/v1/systems", "/v1/systems/compass_walker?pretty", "/nothing"}) {
    EXPECT_EQ(other.handle({.method = "GET", .target = target}).body, get(target).body) << target;
  }
}

TEST(Service, RefusesScenesThatDoNotLoad) {
  EXPECT_THROW(Service({.scenes_directory = "/no/such/directory"}), std::runtime_error);
}

}  // namespace
}  // namespace qdot::api
