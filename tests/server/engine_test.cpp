#include "server/engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/server/answer.hpp"

namespace qdot::server {
namespace {

using testing::HasSubstr;
using testing::Key;
using testing::Not;
using testing::UnorderedElementsAre;

Answer answered(const api::Response& response, const Form& form = {.method = "GET"}) {
  return Answer(to_http(response, form));
}

const api::Response hello{200, "text/csv", {{"ETag", "\"1\""}}, "hello\n"};

std::string unzipped(const std::string& bytes, std::size_t size) {
  std::string text(size + 1, '\0');
  z_stream stream{};
  EXPECT_EQ(::inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(::inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  ::inflateEnd(&stream);
  return text;
}

TEST(Engine, SaysTheResponseAndNothingElse) {
  const auto answer = answered(hello);
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "hello\n");
  const std::map<std::string, std::string> headers{{"Content-Type", "text/csv"},
                                                   {"Content-Length", "6"},
                                                   {"ETag", "\"1\""},
                                                   {"Vary", "Accept-Encoding"},
                                                   {"Connection", "close"}};
  EXPECT_EQ(answer.headers, headers);
  EXPECT_EQ(answered(hello, {.method = "GET", .follow = Follow::keep_alive}).headers.at("Connection"),
            "keep-alive");
}

TEST(Engine, HeadHasTheHeadersOfGetAndNoBody) {
  const auto answer = answered(hello, {.method = "HEAD"});
  EXPECT_EQ(answer.headers, answered(hello).headers);
  EXPECT_EQ(answer.body, "");
}

TEST(Engine, AMethodThatHttplibDoesNotKnowIsAnswered) {
  EXPECT_EQ(answered({405, "text/plain", {{"Allow", "GET"}}, "no\n"}, {.method = "BREW"}).headers.at("Allow"),
            "GET");
  EXPECT_EQ(answered({400, "text/plain", {}, "no\n"}, {}).body, "no\n");
}

TEST(Engine, AnAnswerWithoutContentSaysNothingOfIt) {
  for (const int status : {204, 304}) {
    const auto answer = answered({status, "text/plain", {}, "body"});
    EXPECT_EQ(answer.status, status);
    EXPECT_EQ(answer.body, "");
    EXPECT_THAT(answer.headers, Not(testing::Contains(Key("Content-Length"))));
    EXPECT_THAT(answer.headers, Not(testing::Contains(Key("Content-Type"))));
  }
  EXPECT_THAT(answered({.status = 500}).headers,
              UnorderedElementsAre(Key("Content-Length"), Key("Connection")));
}

TEST(Engine, AValueWithALineEndIsLeftOut) {
  auto response = hello;
  response.headers["X-Split"] = "a\r\nSet-Cookie: b";
  response.headers["X-Whole"] = "c";
  const auto outgoing = to_http(response, {.method = "GET"});
  EXPECT_THAT(std::string(outgoing.head()), Not(HasSubstr("Set-Cookie")));
  EXPECT_THAT(std::string(outgoing.head()), HasSubstr("X-Whole: c\r\n"));
}

TEST(Engine, WhatItCompressesIsWhatComesOut) {
  for (const std::size_t size : {1024, 65536, 1000000}) {
    api::Response response{.content_type = "application/x-ndjson", .headers = {{"ETag", "\"1\""}}};
    for (std::size_t i = 0; i < size; ++i) response.body += static_cast<char>((i * i * 2654435761U) >> 13);
    const Form form{.method = "GET", .accept_encoding = "gzip"};
    const auto answer = answered(response, form);
    EXPECT_EQ(answer.headers.at("Content-Encoding"), "gzip");
    EXPECT_EQ(answer.headers.at("Content-Length"), std::to_string(answer.body.size()));
    EXPECT_EQ(answer.headers.at("Content-Type"), "application/x-ndjson");
    EXPECT_EQ(answer.headers.at("ETag"), "W/\"1\"");
    EXPECT_EQ(unzipped(answer.body, size), response.body);
    EXPECT_EQ(answered(response, form).body, answer.body);
  }
}

TEST(Engine, TheClientDecidesAboutCompression) {
  const api::Response large{.headers = {{"Vary", "Accept"}}, .body = std::string(5000, 'x')};
  const auto compresses = [&](const api::Response& response, const std::string& encodings) {
    const auto answer = answered(response, {.method = "GET", .accept_encoding = encodings});
    return answer.headers.contains("Content-Encoding") && answer.body.size() < response.body.size();
  };
  for (const char* yes : {"gzip", "br, gzip", "GZIP;q=0.5", "*", "deflate;q=1, *;q=0.1", "x-gzip"})
    EXPECT_TRUE(compresses(large, yes)) << yes;
  for (const char* no : {"", "br", "gzip;q=0", "gzip; q=0.000", "*, gzip;q=0", "*;q=0", "gzippo", ",,;"})
    EXPECT_FALSE(compresses(large, no)) << no;
  EXPECT_FALSE(compresses({.body = "small"}, "gzip"));
  EXPECT_FALSE(compresses({.status = 422, .body = large.body}, "gzip"));
  EXPECT_EQ(answered(large).headers.at("Vary"), "Accept, Accept-Encoding");
}

}  // namespace
}  // namespace qdot::server
