#include "server/application.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <functional>
#include <future>
#include <latch>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "server/descriptor.hpp"
#include "tests/server/answer.hpp"

namespace qdot::server {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

api::Request get(const std::string& target) { return {.method = "GET", .target = target}; }

api::Response ok(const api::Request&) { return {.content_type = "application/json", .body = "{}\n"}; }

/// What is asked at these addresses is heavy; all else is light.
api::Appraisal by_address(const api::Request& request) {
  api::Appraisal result{.route = "/v1/{name}"};
  if (request.target == "/v1/lengthy") result.milliseconds = 10000;
  if (request.target == "/v1/large") result.bytes = std::size_t{50} << 20;
  if (request.target == "/v1/heavy" || request.target == "/v1/misjudged" || result.bytes > 0)
    result.milliseconds = 200;
  if (result.milliseconds > 1) result.weight = api::Weight::heavy;
  return result;
}

/// An application with its surroundings.
struct Running {
  explicit Running(std::function<api::Response(const api::Request&)> answer = ok,
                   ApplicationOptions options = {}, int log_descriptor = -1)
      : log(log_descriptor),
        application(options,
                    {.answer = std::move(answer),
                     .appraise = by_address,
                     .unsent_bytes = [this] { return unsent_bytes.load(); },
                     .overloaded = [this] { ++overloaded; }},
                    log, metrics) {}

  /// What it answers, now or later.
  std::future<Answer> ask(Incoming incoming) {
    const auto answer = std::make_shared<std::promise<Answer>>();
    application.handle(std::make_shared<Exchange>(
        std::move(incoming), Follow::keep_alive,
        [answer](const Outgoing& outgoing) { answer->set_value(Answer(outgoing)); }));
    return answer->get_future();
  }
  Answer operator()(Incoming incoming) { return ask(std::move(incoming)).get(); }

  std::atomic<std::size_t> unsent_bytes{0};
  std::atomic<int> overloaded{0};
  RequestLog log;
  Metrics metrics;
  Application application;
};

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
  Running application;
  const auto response =
      application(Refusal{api::ProblemKind::payload_too_large, "Too long.", "POST", "/v1/energy?a"});
  EXPECT_EQ(response.status, 413);
  EXPECT_EQ(response.headers.at("Content-Type"), "application/problem+json");
  const auto body = nlohmann::json::parse(response.body);
  EXPECT_EQ(body["type"], "/errors/payload-too-large");
  EXPECT_EQ(body["title"], "The body is too large");
  EXPECT_EQ(body["status"], 413);
  EXPECT_EQ(body["detail"], "Too long.");
  EXPECT_EQ(body["instance"], "/v1/energy");
}

TEST(Application, AHarmlessRequestIdComesBack) {
  Running application;
  const auto id_for = [&](const std::string& sent) {
    auto request = get("/");
    request.headers["x-request-id"] = sent;
    return application(request).headers.at("X-Request-Id");
  };
  EXPECT_EQ(id_for("job-7.a_B"), "job-7.a_B");
  for (const auto& bad : {std::string("a b"), std::string("a\"b"), std::string(65, 'a'), std::string()}) {
    EXPECT_THAT(id_for(bad), MatchesRegex("[0-9a-f]+")) << bad;
    EXPECT_EQ(id_for(bad).size(), 16u);
  }
}

TEST(Application, WhatExceedsTheQueueIsTurnedAwayAndProbesAreNot) {
  SlowService slow;
  Running application(std::ref(slow), {.lanes = {.threads = 1, .light = {.longest_wait = 0, .waiting = 0}}});
  auto first = application.ask(get("/v1/slow"));
  slow.begun.wait();
  EXPECT_EQ(application.overloaded, 0);
  const auto second = application(get("/v1/energy"));
  EXPECT_EQ(application.overloaded, 1);
  EXPECT_EQ(second.status, 503);
  EXPECT_THAT(second.headers.at("Retry-After"), MatchesRegex("[1-5]"));
  EXPECT_THAT(second.body, HasSubstr("/errors/overloaded"));
  EXPECT_EQ(application(get("/healthz")).status, 200);
  slow.released.count_down();
  EXPECT_EQ(first.get().status, 200);
  while (application(get("/v1/energy")).status != 200) std::this_thread::yield();
}

TEST(Application, HeavyWorkDoesNotWaitForWhatIsLengthyOrLarge) {
  for (const char* other : {"/v1/lengthy", "/v1/large"}) {
    std::latch begun{1};
    std::latch released{1};
    Running application(
        [&](const api::Request& request) {
          if (request.target == other) {
            begun.count_down();
            released.wait();
          }
          return ok(request);
        },
        {.lanes = {.threads = 1, .heavy = {.longest_wait = 0, .waiting = 0, .bytes = std::size_t{1} << 20}}});
    auto first = application.ask(get(other));
    begun.wait();
    EXPECT_EQ(application(get("/v1/heavy")).status, 200) << "beside " << other;
    EXPECT_EQ(application(get("/v1/energy")).status, 200) << "beside " << other;
    released.count_down();
    EXPECT_EQ(first.get().status, 200);
  }
}

TEST(Application, WhatWasThoughtTooLightLetsOthersBegin) {
  std::latch begun{1};
  std::atomic<bool> other_began{false};
  Running application(
      [&](const api::Request& request) {
        if (request.target == "/v1/heavy") other_began = true;
        if (request.target == "/v1/misjudged") {
          begun.count_down();
          while (!other_began && !request.interrupted()) {
          }
        }
        return api::Response{.status = other_began ? 200 : 503};
      },
      {.lanes = {.threads = 1}});
  auto misjudged = application.ask(get("/v1/misjudged"));
  begun.wait();
  EXPECT_EQ(application(get("/v1/heavy")).status, 200);
  EXPECT_EQ(misjudged.get().status, 200) << "it went on until its deadline, and the other waited for it";
}

TEST(Application, DrainingFinishesWhatComputesAndRefusesTheRest) {
  SlowService slow;
  Running application(std::ref(slow), {.lanes = {.threads = 2}});
  auto first = application.ask(get("/v1/slow"));
  slow.begun.wait();
  auto drained = std::async(std::launch::async, [&] { application.application.drain(); });
  while (application(get("/readyz")).status == 200) std::this_thread::yield();
  EXPECT_THAT(application(get("/v1/energy")).body, HasSubstr("/errors/draining"));
  EXPECT_EQ(application(get("/healthz")).headers.at("Connection"), "close");
  slow.released.count_down();
  EXPECT_EQ(first.get().status, 200);
  drained.get();
}

TEST(Application, LogsOneJsonLineARequest) {
  std::FILE* file = std::tmpfile();
  Running application(ok, {}, ::fileno(file));
  (void)application(get("/v1/x?" + std::string(1000, 'a') + "\xff"));
  (void)application(Refusal{api::ProblemKind::invalid_target, "No.", {}, {}});
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

TEST(Application, AFullOrClosedLogCostsLinesAndNoAnswer) {
  for (const char* path : {"/dev/full", "/dev/null"}) {
    const Descriptor device(::open(path, path == std::string_view("/dev/full") ? O_WRONLY : O_RDONLY));
    Running application(ok, {}, device.get());
    EXPECT_EQ(application(get("/v1/x")).status, 200);
    EXPECT_EQ(application.log.dropped(), 1u) << path;
  }
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const Descriptor reader(ends[0]);
  const Descriptor writer(ends[1]);
  Running application(ok, {}, writer.get());
  while (application.log.dropped() < 3) EXPECT_EQ(application(get("/v1/x")).status, 200);
}

TEST(Application, StrangersAreRefused) {
  Running application(ok, {.hosts = {.port = 8080}, .token = "secret"});
  const auto status = [&](std::map<std::string, std::string> headers, const std::string& target = "/v1/x") {
    return application(api::Request{.method = "GET", .target = target, .headers = std::move(headers)}).status;
  };
  const std::string token = "Bearer secret";
  EXPECT_EQ(status({{"host", "localhost:8080"}, {"authorization", token}}), 200);
  EXPECT_EQ(status({{"host", "localhost:8080"}, {"authorization", "bearer  secret "}}), 200);
  EXPECT_EQ(status({{"host", "localhost:8080"}}), 401);
  EXPECT_EQ(status({{"host", "localhost:8080"}, {"authorization", "Bearer secreT"}}), 401);
  EXPECT_EQ(status({{"host", "localhost:8080"}, {"authorization", "Bearer secret2"}}), 401);
  EXPECT_EQ(status({{"host", "localhost:8080"}, {"authorization", "Basic secret"}}), 401);
  EXPECT_EQ(status({{"host", "localhost:8080"}}, "/healthz"), 200);
  EXPECT_EQ(status({{"host", "localhost:8080"}}, "/healthz/x"), 401);
  EXPECT_EQ(status({{"host", "evil.example:8080"}, {"authorization", token}}), 421);
  EXPECT_EQ(status({{"host", "evil.example:8080"}}, "/healthz"), 421);
  EXPECT_EQ(status({{"host", "localhost:8080"}, {"origin", "http://evil.example"}, {"authorization", token}}),
            403);
  EXPECT_EQ(
      status({{"host", "localhost:8080"}, {"origin", "http://localhost:8080"}, {"authorization", token}}),
      200);
}

TEST(Application, ARefusalForWantOfATokenSaysWhatIsWanted) {
  Running application(ok, {.token = "secret"});
  EXPECT_EQ(application(get("/v1/x")).headers.at("WWW-Authenticate"), "Bearer");
}

TEST(Application, WorkIsInterruptedAtTheDeadlineAndWhenItsClientLeaves) {
  std::latch begun{2};
  Running application(
      [&](const api::Request& request) {
        begun.count_down();
        while (!request.interrupted()) std::this_thread::yield();
        return api::Response{.status = 503};
      },
      {.lanes = {.threads = 2}, .deadline = std::chrono::milliseconds(200)});
  auto late = application.ask(get("/v1/a"));
  std::promise<void> given_up;
  const auto exchange =
      std::make_shared<Exchange>(get("/v1/b"), Follow::close, [&](const Outgoing&) { given_up.set_value(); });
  application.application.handle(exchange);
  begun.wait();
  exchange->abandon();
  given_up.get_future().wait();
  EXPECT_EQ(late.get().status, 503);
}

TEST(Application, WhatWaitedIsTurnedAwayIfAnswersHavePiledUpMeanwhile) {
  SlowService slow;
  Running application(std::ref(slow), {.lanes = {.threads = 1}, .unsent_bytes = 100});
  auto first = application.ask(get("/v1/slow"));
  slow.begun.wait();
  auto second = application.ask(get("/v1/energy"));
  application.unsent_bytes = 201;
  EXPECT_THAT(application(get("/v1/energy")).body, HasSubstr("/errors/overloaded"));
  slow.released.count_down();
  EXPECT_EQ(first.get().status, 200);
  EXPECT_THAT(second.get().body, HasSubstr("/errors/overloaded"));
  application.unsent_bytes = 100;
  EXPECT_EQ(application(get("/v1/energy")).status, 200);
}

TEST(Application, WhoWaitedPastTheDeadlineIsNotComputed) {
  constexpr auto deadline = std::chrono::milliseconds(10);
  SlowService slow;
  std::atomic<int> computed{0};
  Running application(
      [&](const api::Request& request) {
        ++computed;
        return slow(request);
      },
      {.lanes = {.threads = 1}, .deadline = deadline});
  auto first = application.ask(get("/v1/slow"));
  // On a loaded machine the first one may have waited too long itself.
  while (!slow.begun.try_wait()) {
    if (first.wait_for(deadline) == std::future_status::ready) first = application.ask(get("/v1/slow"));
  }
  auto second = application.ask(get("/v1/energy"));
  std::this_thread::sleep_for(2 * deadline);
  slow.released.count_down();
  EXPECT_THAT(second.get().body, HasSubstr("/errors/deadline"));
  EXPECT_EQ(first.get().status, 200);
  EXPECT_EQ(computed, 1);
}

TEST(Application, CountsByRouteAndStatus) {
  Running application;
  (void)application(get("/v1/x"));
  (void)application(get("/v1/y"));
  (void)application(Refusal{api::ProblemKind::invalid_target, "No.", {}, {}});
  const auto text = application.metrics.text({}, 0);
  EXPECT_THAT(text, HasSubstr("http_requests_total{method=\"GET\",route=\"/v1/{name}\",code=\"200\"} 2\n"));
  EXPECT_THAT(text, HasSubstr("http_requests_total{method=\"other\",route=\"none\",code=\"400\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("http_request_duration_seconds_count{route=\"/v1/{name}\"} 2\n"));
}

}  // namespace
}  // namespace qdot::server
