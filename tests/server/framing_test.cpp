#include "server/framing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace qdot::server {
namespace {

using testing::HasSubstr;

Head accepted(const std::string& bytes) {
  const auto outcome = read_head(bytes);
  EXPECT_TRUE(std::holds_alternative<Head>(outcome)) << bytes;
  const auto* head = std::get_if<Head>(&outcome);
  return head ? *head : Head{};
}

/// The status with which a request is refused; 0 when it is not.
int refused(const std::string& bytes) {
  const auto outcome = read_head(bytes);
  const auto* refusal = std::get_if<Refusal>(&outcome);
  return refusal ? api::problem_type(refusal->kind).status : 0;
}

std::string post(const std::string& fields) {
  return "POST /v1/energy HTTP/1.1\r\nHost: a\r\n" + fields + "\r\n";
}

TEST(Framing, ReadsARequestAsItStands) {
  const auto head = accepted(
      "POST /v1/energy?pretty HTTP/1.1\r\nHost: a\r\nContent-LENGTH: 12 \r\nAccept: b\r\nAccept:c\r\n\r\n");
  EXPECT_EQ(head.method, "POST");
  EXPECT_EQ(head.target, "/v1/energy?pretty");
  EXPECT_EQ(head.fields.at("accept"), "b, c");
  EXPECT_EQ(head.content_length, 12u);
  EXPECT_TRUE(head.keep_alive);
}

TEST(Framing, KnowsWhereAHeadEnds) {
  EXPECT_EQ(head_end("GET / HTTP/1.1\r\nHost: a\r\n"), std::string_view::npos);
  EXPECT_EQ(head_end("GET / HTTP/1.1\r\n\r\nrest"), 18u);
}

TEST(Framing, ABareLineFeedEndsAHeadAndIsRefused) {
  const std::string bytes = "GET / HTTP/1.0\n\n";
  EXPECT_EQ(head_end(bytes), bytes.size());
  EXPECT_EQ(refused(bytes), 400);
}

TEST(Framing, TheFormForProxiesMeansTheSamePath) {
  EXPECT_EQ(accepted("GET http://a:1/v1/x?b HTTP/1.1\r\nHost: a\r\n\r\n").target, "/v1/x?b");
  EXPECT_EQ(accepted("GET HTTP://a HTTP/1.1\r\nHost: a\r\n\r\n").target, "/");
  EXPECT_EQ(accepted("GET http://a?b HTTP/1.1\r\nHost: a\r\n\r\n").target, "/?b");
}

TEST(Framing, KeepAliveFollowsVersionAndConnection) {
  EXPECT_FALSE(accepted("GET / HTTP/1.0\r\n\r\n").keep_alive);
  EXPECT_TRUE(accepted("GET / HTTP/1.0\r\nConnection: Keep-Alive\r\n\r\n").keep_alive);
  EXPECT_FALSE(accepted(post("Content-Length: 0\r\nConnection: x, Close\r\n")).keep_alive);
}

TEST(Framing, RefusesWhatTwoReadersCouldUnderstandDifferently) {
  for (const char* fields :
       {"Content-Length: 1\r\nContent-Length: 1\r\n", "Content-Length: +2\r\n", "Content-Length: 2, 2\r\n",
        "Content-Length: abc\r\n", "Content-Length:\r\n", "Content-Length : 2\r\n", "A: b\r\n c\r\n",
        "Host: b\r\n", "A: b\nC: d\r\n", "no colon\r\n", ": b\r\n", "A: \x01\r\n"}) {
    EXPECT_EQ(refused(post(fields)), 400) << fields;
  }
  EXPECT_EQ(refused(post(std::string("A: b\0c\r\n", 8))), 400);
}

TEST(Framing, RefusesRequestLinesThatAreNone) {
  for (const char* line : {"GARBAGE", "GET /", "GET  HTTP/1.1", "GET / HTTP/2.0", "GET / http/1.1",
                           "G(T / HTTP/1.1", "GET /a b HTTP/1.1"}) {
    EXPECT_EQ(refused(std::string(line) + "\r\nHost: a\r\n\r\n"), 400) << line;
  }
  EXPECT_EQ(refused("GET / HTTP/1.1\r\n\r\n"), 400) << "no Host";
}

TEST(Framing, RefusesBodiesThatItWouldNotRead) {
  EXPECT_EQ(refused(post("")), 411);
  EXPECT_EQ(refused(post("Transfer-Encoding: chunked\r\n")), 411);
  EXPECT_EQ(refused(post("Transfer-Encoding: xchunked\r\nContent-Length: 3\r\n")), 411);
  EXPECT_EQ(refused(post("Content-Encoding: gzip\r\n")), 415);
  EXPECT_EQ(refused(post("Expect: a-miracle\r\n")), 417);
  EXPECT_EQ(refused(post("Content-Length: 1048577\r\n")), 413);
  EXPECT_EQ(refused(post("Content-Length: 99999999999999999999\r\n")), 413);
  EXPECT_EQ(accepted(post("Content-Length: 1048576\r\n")).content_length, max_body_bytes);
}

TEST(Framing, BoundsTargetAndFields) {
  EXPECT_EQ(refused("GET /" + std::string(max_target_bytes, 'a') + " HTTP/1.1\r\nHost: a\r\n\r\n"), 414);
  std::string fields;
  for (std::size_t i = 0; i < max_fields; ++i) fields += "X-" + std::to_string(i) + ": a\r\n";
  EXPECT_EQ(refused(post(fields)), 431);
  EXPECT_EQ(oversized_head(std::string(max_head_bytes, 'a')).kind, api::ProblemKind::target_too_long);
  EXPECT_EQ(oversized_head("GET / HTTP/1.1\r\nA: " + std::string(max_head_bytes, 'a')).kind,
            api::ProblemKind::headers_too_large);
}

TEST(Framing, ARefusalSaysWhatWasReadSoFar) {
  const auto outcome = read_head(post("Transfer-Encoding: chunked\r\n"));
  const auto& refusal = std::get<Refusal>(outcome);
  EXPECT_EQ(refusal.method, "POST");
  EXPECT_EQ(refusal.target, "/v1/energy");
  EXPECT_THAT(refusal.detail, HasSubstr("Content-Length"));
}

}  // namespace
}  // namespace qdot::server
