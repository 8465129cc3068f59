#include "server/refusals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/server/answer.hpp"

namespace qdot::server {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

Refusals::Asked energy() { return {.method = "POST", .path = "/v1/energy", .follow = Follow::keep_alive}; }

TEST(Refusals, AreProblemsWithTheIdOfTheirRequestAndATimeToComeBack) {
  Refusals refusals;
  for (const auto* id : {"one", "a-second.request_of-many"}) {
    const Answer answer(refusals.answer(energy(), id, "3"));
    EXPECT_EQ(answer.status, 503);
    EXPECT_EQ(answer.headers.at("X-Request-Id"), id);
    EXPECT_EQ(answer.headers.at("Retry-After"), "3");
    EXPECT_EQ(answer.headers.at("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(answer.headers.at("Content-Type"), "application/problem+json");
    EXPECT_EQ(answer.headers.at("Connection"), "keep-alive");
    EXPECT_EQ(answer.headers.at("Content-Length"), std::to_string(answer.body.size()));
    EXPECT_THAT(answer.headers, SizeIs(6));
    EXPECT_THAT(answer.body, HasSubstr(R"("type":"/errors/overloaded")"));
    EXPECT_THAT(answer.body, HasSubstr(R"("instance":"/v1/energy")"));
  }
}

TEST(Refusals, TellAddressesMethodsAndConnectionsApart) {
  Refusals refusals;
  const auto ask = [&](Refusals::Asked asked) { return Answer(refusals.answer(asked, "id", "1")); };
  const auto first = ask(energy());
  EXPECT_THAT(ask({.method = "GET", .path = "/v1/modes"}).body, HasSubstr("/v1/modes"));
  EXPECT_EQ(ask({.method = "GET", .path = "/v1/energy"}).headers.at("Connection"), "close");
  const auto head = ask({.method = "HEAD", .path = "/v1/energy", .follow = Follow::keep_alive});
  EXPECT_EQ(head.body, "");
  EXPECT_EQ(head.headers.at("Content-Length"), first.headers.at("Content-Length"));
  EXPECT_EQ(ask(energy()).body, first.body);
}

TEST(Refusals, OfMoreAddressesThanAreKeptAreStillTheirOwn) {
  Refusals refusals;
  for (int i = 0; i < 200; ++i) {
    const auto path = "/v1/systems/" + std::to_string(i);
    EXPECT_THAT(Answer(refusals.answer({.path = path}, "id", "1")).body, HasSubstr("\"" + path + "\""));
  }
}

}  // namespace
}  // namespace qdot::server
