#include "server/message_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace qdot::server {
namespace {

const std::string two_requests =
    "\r\nPOST /1 HTTP/1.1\r\nHost: a\r\nContent-Length: 11\r\n\r\nab\r\n\r\ncd\r\nx"
    "GET /2 HTTP/1.0\r\n\r\n";

std::vector<std::string> read_in_pieces(const std::string& bytes, std::size_t piece) {
  MessageReader reader;
  std::vector<std::string> seen;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    reader.append(std::string_view(bytes).substr(at, piece));
    while (auto incoming = reader.next()) {
      if (const auto* refusal = std::get_if<Refusal>(&*incoming)) {
        seen.push_back("refused: " + refusal->detail);
        return seen;
      }
      const auto& request = std::get<api::Request>(*incoming);
      seen.push_back(request.method + " " + request.target + " " + request.body);
    }
  }
  return seen;
}

TEST(MessageReader, HoweverTheBytesAreCutTheRequestsAreTheSame) {
  const std::vector<std::string> expected{"POST /1 ab\r\n\r\ncd\r\nx", "GET /2 "};
  for (std::size_t piece = 1; piece <= two_requests.size(); ++piece)
    EXPECT_EQ(read_in_pieces(two_requests, piece), expected) << piece;
}

TEST(MessageReader, ARefusalComesAtTheSameByteHoweverTheyAreCut) {
  const std::string bytes = "GET / HTTP/1.1\r\nHost: a\r\nA : b\r\n\r\n";
  for (std::size_t piece = 1; piece <= bytes.size(); ++piece)
    EXPECT_EQ(read_in_pieces(bytes, piece), read_in_pieces(bytes, bytes.size())) << piece;
}

TEST(MessageReader, AHeadThatGoesOnIsRefusedAndNotKept) {
  MessageReader reader;
  std::size_t sent = 0;
  std::optional<Incoming> incoming;
  while (!incoming && sent < 10 * max_head_bytes) {
    reader.append(std::string(100, 'a'));
    sent += 100;
    incoming = reader.next();
  }
  ASSERT_TRUE(incoming);
  EXPECT_LE(sent, max_head_bytes + 100);
  EXPECT_EQ(std::get<Refusal>(*incoming).kind, api::ProblemKind::target_too_long);
}

TEST(MessageReader, KnowsWhetherAnythingHasBegun) {
  MessageReader reader;
  reader.append("\r\n\r\n");
  EXPECT_FALSE(reader.next());
  EXPECT_TRUE(reader.idle());
  reader.append("G");
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.idle());
  reader.append("ET / HTTP/1.1\r\nHost: a\r\nContent-Length: 1\r\n\r\n");
  EXPECT_FALSE(reader.next());
  ASSERT_NE(reader.head(), nullptr);
  EXPECT_EQ(reader.head()->content_length, 1u);
  reader.append("x");
  EXPECT_TRUE(reader.next());
  EXPECT_TRUE(reader.idle());
  EXPECT_TRUE(reader.keep_alive());
}

}  // namespace
}  // namespace qdot::server
