#include "server/transport.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <latch>
#include <stdexcept>
#include <string>
#include <thread>

namespace qdot::server {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Echoes method, target and body; a refusal's status comes back as it is.
api::Response echo(const Incoming& incoming) {
  if (const auto* refusal = std::get_if<Refusal>(&incoming)) {
    return {api::problem_type(refusal->kind).status, "text/plain", {}, "refused\n"};
  }
  const auto& request = std::get<api::Request>(incoming);
  if (request.target == "/throw") throw std::runtime_error("secret");
  return {200, "text/plain", {}, request.method + " " + request.target + " " + request.body + "\n"};
}

class RunningTransport {
 public:
  explicit RunningTransport(Handler handler = echo, int connections = 8)
      : transport_({.port = 0, .connections = connections}, std::move(handler)),
        thread_([this] { transport_.run(); }) {}
  ~RunningTransport() { stop(); }

  void stop() {
    if (!thread_.joinable()) return;
    transport_.stop();
    thread_.join();
  }
  Transport& transport() { return transport_; }
  int port() const { return transport_.port(); }

 private:
  Transport transport_;
  std::thread thread_;
};

class Client {
 public:
  explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(std::string_view bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }

  /// All bytes up to `mark`, or up to the end of the connection.
  std::string read_to(std::string_view mark) const {
    std::string bytes;
    char byte = 0;
    while (!(!mark.empty() && bytes.ends_with(mark)) && ::recv(socket_, &byte, 1, 0) == 1) bytes += byte;
    return bytes;
  }
  std::string read_all() const { return read_to(""); }

 private:
  int socket_;
};

constexpr std::string_view close_after = "GET /last HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";

TEST(Transport, OneConnectionCarriesManyRequests) {
  RunningTransport server;
  const Client client(server.port());
  for (int i = 0; i < 3; ++i) {
    client.send("POST /p HTTP/1.1\r\nHost: a\r\nContent-Length: 4\r\n\r\nbody");
    EXPECT_THAT(client.read_to("body\n"), HasSubstr("Connection: keep-alive\r\n\r\nPOST /p body"));
  }
  client.send(close_after);
  EXPECT_THAT(client.read_all(), EndsWith("Connection: close\r\n\r\nGET /last \n"));
}

TEST(Transport, PipelinedRequestsAreAnsweredInOrder) {
  RunningTransport server;
  const Client client(server.port());
  client.send(
      "\r\nGET /1 HTTP/1.1\r\nHost: a\r\n\r\nPOST /2 HTTP/1.1\r\nHost: a\r\nContent-Length: 1\r\n\r\nx" +
      std::string(close_after));
  const auto answer = client.read_all();
  EXPECT_LT(answer.find("GET /1"), answer.find("POST /2 x"));
  EXPECT_LT(answer.find("POST /2 x"), answer.find("GET /last"));
}

TEST(Transport, TheBodyOfAGetIsNotTheNextRequest) {
  RunningTransport server;
  const Client client(server.port());
  client.send("GET /1 HTTP/1.1\r\nHost: a\r\nContent-Length: 22\r\n\r\n");
  client.send("GET /evil HTTP/1.1\r\n\r\n");
  client.send(close_after);
  EXPECT_THAT(client.read_to("/evil HTTP/1.1\r\n\r\n\n"), HasSubstr("GET /1 GET /evil"));
  const auto rest = client.read_all();
  EXPECT_EQ(rest.find("200 OK"), rest.rfind("200 OK")) << rest;
}

TEST(Transport, HeadHasTheHeadersOfGetAndNoBody) {
  RunningTransport server;
  const Client client(server.port());
  client.send("HEAD /h HTTP/1.0\r\n\r\n");
  const auto answer = client.read_all();
  EXPECT_THAT(answer, HasSubstr("Content-Length: 9\r\n"));
  EXPECT_THAT(answer, EndsWith("\r\n\r\n"));
}

TEST(Transport, ARefusedClientReadsWhyEvenWhenItIsStillSending) {
  RunningTransport server;
  const Client client(server.port());
  client.send("POST /p HTTP/1.1\r\nHost: a\r\nContent-Length: 2000000\r\n\r\n" + std::string(100000, 'x'));
  EXPECT_THAT(client.read_to("refused\n"), StartsWith("HTTP/1.1 413 "));
}

TEST(Transport, AHeadWithoutEndIsRefused) {
  RunningTransport server;
  const Client client(server.port());
  client.send("GET / HTTP/1.1\r\nA: " + std::string(max_head_bytes, 'a'));
  EXPECT_THAT(client.read_to("refused\n"), StartsWith("HTTP/1.1 431 "));
}

TEST(Transport, ContinueIsSaidBeforeTheBody) {
  RunningTransport server;
  const Client client(server.port());
  client.send("POST /p HTTP/1.0\r\nExpect: 100-continue\r\nContent-Length: 4\r\n\r\n");
  EXPECT_EQ(client.read_to("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  client.send("body");
  EXPECT_THAT(client.read_all(), EndsWith("POST /p body\n"));
}

TEST(Transport, AnExceptionIsAPlainProblem) {
  RunningTransport server;
  const Client client(server.port());
  client.send("GET /throw HTTP/1.0\r\n\r\n");
  const auto answer = client.read_all();
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 500 "));
  EXPECT_THAT(answer, HasSubstr("application/problem+json"));
  EXPECT_THAT(answer, Not(HasSubstr("secret")));
}

TEST(Transport, IdleConnectionsGiveWay) {
  RunningTransport server(echo, 2);
  const Client first(server.port());
  const Client second(server.port());
  for (const auto* client : {&first, &second}) {
    client->send("GET /idle HTTP/1.1\r\nHost: a\r\n\r\n");
    (void)client->read_to("/idle \n");
  }
  const Client third(server.port());
  third.send(close_after);
  EXPECT_THAT(third.read_all(), EndsWith("GET /last \n"));
}

TEST(Transport, StopFinishesWhatIsInFlight) {
  std::latch begun{1};
  std::latch released{1};
  RunningTransport server([&](const Incoming& incoming) {
    begun.count_down();
    released.wait();
    return echo(incoming);
  });
  const Client client(server.port());
  client.send("GET /slow HTTP/1.1\r\nHost: a\r\n\r\n");
  begun.wait();
  std::thread stopper([&] { server.transport().stop(); });
  released.count_down();
  EXPECT_THAT(client.read_all(), EndsWith("GET /slow \n"));
  stopper.join();
  server.stop();
}

TEST(Transport, TwoServersCannotShareAPort) {
  RunningTransport server;
  try {
    const Transport second({.port = server.port()}, echo);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("Address already in use"));
  }
}

}  // namespace
}  // namespace qdot::server
