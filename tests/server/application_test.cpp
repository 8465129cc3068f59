#include "server/application.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <latch>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

namespace qdot::server {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

api::Request get(const std::string& target) { return {.method = "GET", .target = target}; }

api::Response ok(const api::Request&) { return {.content_type = "application/json", .body = "{}\n"}; }

/// What the application answers, now or later.
std::future<api::Response> ask(Application& application, Incoming incoming) {
  const auto answer = std::make_shared<std::promise<api::Response>>();
  application.handle(std::make_shared<Exchange>(
      std::move(incoming), [answer](api::Response response) { answer->set_value(std::move(response)); }));
  return answer->get_future();
}

api::Response answer_of(Application& application, Incoming incoming) {
  return ask(application, std::move(incoming)).get();
}

/// A service whose first computation waits until it is released.
struct SlowService {
  std::latch begun{1};
  std::latch released{1};

  api::Response operator()(const api::Request& request) {
    if (request.target == "/v1/slow") {
      begun.count_down();
      released.wait();
    }
    return ok(request);
  }
};

TEST(Application, ARefusalBecomesAProblem) {
  Application application({}, ok);
  const auto response = answer_of(
      application, Refusal{api::ProblemKind::payload_too_large, "Too long.", "POST", "/v1/energy?a"});
  EXPECT_EQ(response.status, 413);
  EXPECT_EQ(response.content_type, "application/problem+json");
  const auto body = nlohmann::json::parse(response.body);
  EXPECT_EQ(body["type"], "/errors/payload-too-large");
  EXPECT_EQ(body["title"], "The body is too large");
  EXPECT_EQ(body["status"], 413);
  EXPECT_EQ(body["detail"], "Too long.");
  EXPECT_EQ(body["instance"], "/v1/energy");
}

TEST(Application, AHarmlessRequestIdComesBack) {
  Application application({}, ok);
  const auto id_for = [&](const std::string& sent) {
    auto request = get("/");
    request.headers["x-request-id"] = sent;
    return answer_of(application, request).headers.at("X-Request-Id");
  };
  EXPECT_EQ(id_for("job-7.a_B"), "job-7.a_B");
  for (const auto& bad : {std::string("a b"), std::string("a\"b"), std::string(65, 'a'), std::string()}) {
    EXPECT_THAT(id_for(bad), MatchesRegex("[0-9a-f]+")) << bad;
    EXPECT_EQ(id_for(bad).size(), 16u);
  }
}

TEST(Application, WhatExceedsTheQueueIsTurnedAwayAndProbesAreNot) {
  SlowService slow;
  Application application({.lanes = {.threads = 1, .light = {.longest_wait = 0, .waiting = 0}}},
                          std::ref(slow));
  auto first = ask(application, get("/v1/slow"));
  slow.begun.wait();
  const auto second = answer_of(application, get("/v1/energy"));
  EXPECT_EQ(second.status, 503);
  EXPECT_THAT(second.headers.at("Retry-After"), MatchesRegex("[1-5]"));
  EXPECT_THAT(second.body, HasSubstr("/errors/overloaded"));
  EXPECT_EQ(answer_of(application, get("/healthz")).status, 200);
  slow.released.count_down();
  EXPECT_EQ(first.get().status, 200);
  while (answer_of(application, get("/v1/energy")).status != 200) std::this_thread::yield();
}

TEST(Application, DrainingFinishesWhatComputesAndRefusesTheRest) {
  SlowService slow;
  Application application({.lanes = {.threads = 2}}, std::ref(slow));
  auto first = ask(application, get("/v1/slow"));
  slow.begun.wait();
  auto drained = std::async(std::launch::async, [&] { application.drain(); });
  while (answer_of(application, get("/readyz")).status == 200) std::this_thread::yield();
  EXPECT_THAT(answer_of(application, get("/v1/energy")).body, HasSubstr("/errors/draining"));
  EXPECT_EQ(answer_of(application, get("/healthz")).status, 200);
  slow.released.count_down();
  EXPECT_EQ(first.get().status, 200);
  drained.get();
}

TEST(Application, LogsOneJsonLineARequest) {
  std::FILE* file = std::tmpfile();
  Application application({.log = file}, ok);
  (void)answer_of(application, get("/v1/x?" + std::string(1000, 'a') + "\xff"));
  (void)answer_of(application, Refusal{api::ProblemKind::invalid_target, "No.", {}, {}});
  std::rewind(file);
  std::string text(4096, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  const auto end = text.find('\n');
  const auto first = nlohmann::json::parse(text.substr(0, end));
  const auto second = nlohmann::json::parse(text.substr(end));
  EXPECT_EQ(first["method"], "GET");
  EXPECT_EQ(first["target"].get<std::string>().size(), 200u);
  EXPECT_EQ(first["status"], 200);
  EXPECT_EQ(second["status"], 400);
}

}  // namespace
}  // namespace qdot::server
