#include "server/transport.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <latch>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/running_transport.hpp"

namespace qdot::server {
namespace {

using namespace std::chrono_literals;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view close_after = "GET /last HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";

TEST(Transport, OneConnectionCarriesManyRequests) {
  RunningTransport server;
  httplib::Client client(loopback, server.port());
  client.set_keep_alive(true);
  for (int i = 0; i < 3; ++i) {
    const auto answer = client.Post("/p", "body", "text/plain");
    EXPECT_EQ(answer->get_header_value("Connection"), "keep-alive");
    EXPECT_EQ(answer->body, "POST /p body\n");
    EXPECT_EQ(server.transport().gauges().connections, 1u);
  }
  client.set_keep_alive(false);
  EXPECT_EQ(client.Get("/last")->get_header_value("Connection"), "close");
}

TEST(Transport, LooksAwayForAWhileAfterItWasToldToRest) {
  std::vector<Clock::time_point> handled;
  std::optional<Transport> transport;
  transport.emplace(TransportOptions{.port = 0}, [&](const std::shared_ptr<Exchange>& exchange) {
    handled.push_back(Clock::now());
    transport->rest();
    exchange->answer(to_http(echo(exchange->incoming), {.method = "GET", .follow = exchange->follow}));
  });
  std::thread thread([&] { transport->run(); });
  httplib::Client client(loopback, transport->port());
  client.set_keep_alive(true);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(client.Get("/")->status, 200);
  transport->stop();
  thread.join();
  for (std::size_t i = 1; i < handled.size(); ++i) EXPECT_GE(handled[i] - handled[i - 1], 4ms);
}

TEST(Transport, PipelinedRequestsAreAnsweredInOrder) {
  RunningTransport server;
  const RawClient client(server.port());
  client.send(
      "\r\nGET /1 HTTP/1.1\r\nHost: a\r\n\r\nPOST /2 HTTP/1.1\r\nHost: a\r\nContent-Length: 1\r\n\r\nx" +
      std::string(close_after));
  const auto answer = client.read_all();
  EXPECT_LT(answer.find("GET /1"), answer.find("POST /2 x"));
  EXPECT_LT(answer.find("POST /2 x"), answer.find("GET /last"));
}

TEST(Transport, TheBodyOfAGetIsNotTheNextRequest) {
  RunningTransport server;
  const RawClient client(server.port());
  client.send("GET /1 HTTP/1.1\r\nHost: a\r\nContent-Length: 22\r\n\r\n");
  client.send("GET /evil HTTP/1.1\r\n\r\n");
  client.send(close_after);
  EXPECT_THAT(client.read_to("/evil HTTP/1.1\r\n\r\n\n"), HasSubstr("GET /1 GET /evil"));
  const auto rest = client.read_all();
  EXPECT_EQ(rest.find("200 OK"), rest.rfind("200 OK")) << rest;
}

TEST(Transport, ARefusedClientReadsWhyEvenWhenItIsStillSending) {
  RunningTransport server;
  const RawClient client(server.port());
  client.send("POST /p HTTP/1.1\r\nHost: a\r\nContent-Length: 2000000\r\n\r\n" + std::string(100000, 'x'));
  EXPECT_THAT(client.read_to("refused\n"), StartsWith("HTTP/1.1 413 "));
}

TEST(Transport, AHeadWithoutEndIsRefused) {
  RunningTransport server;
  const RawClient client(server.port());
  client.send("GET / HTTP/1.1\r\nA: " + std::string(max_head_bytes, 'a'));
  EXPECT_THAT(client.read_to("refused\n"), StartsWith("HTTP/1.1 431 "));
}

TEST(Transport, ContinueIsSaidBeforeTheBody) {
  RunningTransport server;
  const RawClient client(server.port());
  client.send("POST /p HTTP/1.0\r\nExpect: 100-continue\r\nContent-Length: 4\r\n\r\n");
  EXPECT_EQ(client.read_to("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  client.send("body");
  EXPECT_THAT(client.read_all(), EndsWith("POST /p body\n"));
}

TEST(Transport, WhatNobodyAnswersIsAPlain500) {
  RunningTransport server;
  const auto answer = httplib::Client(loopback, server.port()).Get("/throw");
  EXPECT_EQ(answer->status, 500);
  EXPECT_EQ(answer->body, "");
  EXPECT_EQ(answer->headers.size(), 2u) << "Content-Length and Connection";
}

TEST(Transport, TheConnectionThatWaitedLongestGivesWay) {
  RunningTransport server(echo, {.port = 0, .connections = 2});
  const RawClient first(server.port());
  const RawClient second(server.port());
  for (const auto* client : {&first, &second}) {
    client->send("GET /idle HTTP/1.1\r\nHost: a\r\n\r\n");
    (void)client->read_to("/idle \n");
    std::this_thread::sleep_for(100ms);  // the client has its answer a moment before the poller knows of it
  }
  const RawClient third(server.port());
  third.send(close_after);
  EXPECT_THAT(third.read_all(), EndsWith("GET /last \n"));
  EXPECT_EQ(first.read_all(), "");
  second.send(close_after);
  EXPECT_THAT(second.read_all(), EndsWith("GET /last \n"));
}

TEST(Transport, SlowAndSilentClientsAreToldSo) {
  constexpr Patience short_patience{.head = 100ms, .request = 300ms, .idle = 200ms};
  RunningTransport server(echo, {.port = 0, .patience = short_patience});
  const RawClient silent(server.port());
  const RawClient in_head(server.port());
  const RawClient in_body(server.port());
  in_head.send("GET / HTTP/1.1\r\nHos");
  in_body.send("POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 5\r\n\r\n1234");
  for (const auto* client : {&silent, &in_head, &in_body})
    EXPECT_THAT(client->read_all(), StartsWith("HTTP/1.1 408 "));
  const RawClient idle(server.port());
  idle.send("GET / HTTP/1.1\r\nHost: a\r\n\r\n");
  (void)idle.read_to("GET / \n");
  EXPECT_EQ(idle.read_all(), "") << "an idle connection just ends";
}

TEST(Transport, AByteAtATimeIsTheSameRequest) {
  RunningTransport server;
  const RawClient client(server.port());
  const std::string bytes =
      "POST /p HTTP/1.1\r\nHost: a\r\nContent-Length: 2\r\n\r\nxy" + std::string(close_after);
  for (const char& byte : bytes) client.send({&byte, 1});
  const auto answer = client.read_all();
  EXPECT_THAT(answer, HasSubstr("POST /p xy\n"));
  EXPECT_THAT(answer, EndsWith("GET /last \n"));
}

/// More than the kernel keeps for a client that does not read.
const std::string large(std::size_t{12} << 20, 'x');

api::Response large_answer(const Incoming&) { return {.status = 200, .body = large}; }

TEST(Transport, ALargeAnswerReachesASlowReaderWhole) {
  RunningTransport server(large_answer, {.port = 0, .patience = {.write = 600s}});
  const RawClient slow(server.port());
  slow.send(close_after);
  while (server.transport().gauges().unsent_bytes == 0) std::this_thread::yield();
  EXPECT_GT(server.transport().gauges().unsent_bytes, std::size_t{1} << 20);
  EXPECT_TRUE(httplib::Client(loopback, server.port()).Get("/quick")->body == large);
  EXPECT_TRUE(slow.read_large().ends_with("\r\n\r\n" + large));
  while (server.transport().gauges().unsent_bytes != 0) std::this_thread::yield();
}

TEST(Transport, AReaderThatStopsIsCutOff) {
  RunningTransport server(large_answer, {.port = 0, .patience = {.write = 200ms}});
  const RawClient client(server.port());
  client.send(close_after);
  while (server.transport().gauges().unsent_bytes == 0) std::this_thread::yield();
  while (server.transport().gauges().connections != 0) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(server.transport().gauges().unsent_bytes, 0u);
}

TEST(Transport, AReaderThatIsSlowAndReadsIsNotCutOff) {
  RunningTransport server(large_answer, {.port = 0, .patience = {.write = 300ms}});
  const RawClient slow(server.port());
  slow.send(close_after);
  while (server.transport().gauges().unsent_bytes == 0) std::this_thread::yield();
  std::size_t read = 0;
  for (int i = 0; i < 40; ++i) {  // by less than the kernel waits for before it asks for more
    read += slow.read_some(20'000);
    std::this_thread::sleep_for(30ms);
  }
  EXPECT_GT(read + slow.read_large().size(), large.size());
}

TEST(Transport, WhereAnswersCrowdThoseWhoReadSlowlyAreCutOff) {
  RunningTransport server(
      large_answer, {.port = 0, .unsent_bytes = large.size(), .patience = {.write = 600s, .crowded = 100ms}});
  const RawClient one(server.port());
  one.send(close_after);
  while (server.transport().gauges().unsent_bytes == 0) std::this_thread::yield();
  std::this_thread::sleep_for(400ms);
  EXPECT_EQ(server.transport().gauges().connections, 1u) << "nobody is in its way";
  const RawClient other(server.port());
  other.send(close_after);
  while (server.transport().gauges().connections != 2) std::this_thread::sleep_for(1ms);
  while (server.transport().gauges().connections != 1) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(400ms);
  EXPECT_EQ(server.transport().gauges().connections, 1u) << "one was enough";
}

TEST(Transport, WhatIsSentIsKeptNoLonger) {
  const std::string body = large + large + large;
  RunningTransport server([&](const Incoming&) { return api::Response{.status = 200, .body = body}; },
                          {.port = 0, .patience = {.write = 600s}});
  const RawClient slow(server.port());
  slow.send(close_after);
  while (server.transport().gauges().unsent_bytes == 0) std::this_thread::yield();
  std::string read;
  while (read.size() < 2 * large.size()) read += slow.read_part(1 << 16);
  while (server.transport().gauges().unsent_bytes > large.size()) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(server.transport().gauges().connections, 1u);
  read += slow.read_large();
  EXPECT_TRUE(read.ends_with("\r\n\r\n" + body));
}

TEST(Transport, WhoReadsNothingGivesWayBeforeWhoReadsSlowly) {
  const std::string more = large + large + large + large + large;
  const auto answer = [&](const Incoming& incoming) {
    return api::Response{.status = 200,
                         .body = std::get<api::Request>(incoming).target == "/less" ? large : more};
  };
  RunningTransport server(
      answer,
      {.port = 0, .unsent_bytes = more.size() + large.size(), .patience = {.write = 600s, .crowded = 100ms}});
  const RawClient silent(server.port()), slow(server.port());
  silent.send("GET /less HTTP/1.1\r\nHost: a\r\n\r\n");
  slow.send(close_after);
  std::string read;
  for (int i = 0; i < 30; ++i) {
    read += slow.read_part(1 << 14);
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_EQ(server.transport().gauges().connections, 2u);
  const RawClient third(server.port());
  third.send(close_after);
  while (server.transport().gauges().connections != 1) {
    read += slow.read_part(1 << 14);
    std::this_thread::sleep_for(1ms);
  }
  read += slow.read_large();
  EXPECT_TRUE(read.ends_with("\r\n\r\n" + more));
}

TEST(Transport, ProbesAreAnsweredWhileAnswersGoOut) {
  RunningTransport server(
      [](const Incoming& incoming) {
        return std::get<api::Request>(incoming).target == "/last" ? large_answer(incoming) : echo(incoming);
      },
      {.port = 0, .patience = {.write = 600s}});
  const RawClient slow(server.port());
  slow.send(close_after);
  while (server.transport().gauges().unsent_bytes == 0) std::this_thread::yield();
  server.transport().stop();
  for (int i = 0; i < 20; ++i) {
    const RawClient probe(server.port());
    std::this_thread::sleep_for(5ms);
    probe.send("GET /probe HTTP/1.1\r\nHost: a\r\n\r\n");
    EXPECT_THAT(probe.read_all(), EndsWith("GET /probe \n"));
  }
  EXPECT_TRUE(slow.read_large().ends_with(large));
  server.stop();
}

TEST(Transport, AReaderThatIsSlowDoesNotHoldUpTheEnd) {
  RunningTransport server(large_answer, {.port = 0, .patience = {.write = 300ms}});
  const RawClient client(server.port());
  client.send(close_after);
  while (server.transport().gauges().unsent_bytes == 0) std::this_thread::yield();
  std::atomic<bool> ended{false};
  std::thread reader([&] {
    while (!ended) {
      (void)client.read_some(1 << 17);
      std::this_thread::sleep_for(20ms);
    }
  });
  server.stop();
  ended = true;
  reader.join();
  EXPECT_EQ(server.transport().gauges().connections, 0u);
}

TEST(Transport, WhoeverWorksForAClientLearnsThatItLeft) {
  std::latch begun{1};
  std::latch abandoned{1};
  Transport transport({.port = 0}, [&](const std::shared_ptr<Exchange>& exchange) {
    std::thread([&, exchange] {
      begun.count_down();
      while (!exchange->abandoned()) std::this_thread::sleep_for(1ms);
      exchange->answer(Outgoing::out_of_memory());
      abandoned.count_down();
    }).detach();
  });
  std::thread poller([&] { transport.run(); });
  std::optional<RawClient> client(transport.port());
  client->send("GET /slow HTTP/1.1\r\nHost: a\r\n\r\n");
  begun.wait();
  const auto left = Clock::now();
  client.reset();
  abandoned.wait();
  EXPECT_LT(Clock::now() - left, 1s);  // the promise of 100 ms is that of an idle machine
  transport.stop();
  poller.join();
}

TEST(Transport, AClientThatOnlyStopsSendingGetsItsAnswer) {
  RunningTransport server;
  const RawClient client(server.port());
  client.send("GET /half HTTP/1.1\r\nHost: a\r\n\r\n");
  client.stop_sending();
  EXPECT_THAT(client.read_all(), EndsWith("GET /half \n"));
}

TEST(Transport, AUnixSocketIsItsOwnersAlone) {
  const std::string path = testing::TempDir() + "qdot_transport_test.sock";
  {
    RunningTransport server(echo, {.port = {}, .unix_socket = path});
    struct stat found {};
    ASSERT_EQ(::stat(path.c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777, 0600u);
    httplib::Client client(path);
    client.set_address_family(AF_UNIX);
    EXPECT_EQ(client.Get("/u")->body, "GET /u \n");
    EXPECT_THROW(Transport({.port = {}, .unix_socket = path}, {}), std::runtime_error);
  }
  EXPECT_NE(::access(path.c_str(), F_OK), 0);
}

TEST(Transport, StopFinishesWhatIsInFlight) {
  std::latch begun{1};
  std::latch released{1};
  RunningTransport server([&](const Incoming& incoming) {
    begun.count_down();
    released.wait();
    return echo(incoming);
  });
  const RawClient client(server.port());
  client.send("GET /slow HTTP/1.1\r\nHost: a\r\n\r\n");
  begun.wait();
  std::thread stopper([&] { server.transport().stop(); });
  released.count_down();
  EXPECT_THAT(client.read_all(), EndsWith("GET /slow \n"));
  stopper.join();
  server.stop();
}

TEST(Transport, StopAnswersWhoIsStillSending) {
  RunningTransport server;
  const RawClient client(server.port());
  client.send(
      "GET /first HTTP/1.1\r\nHost: a\r\n\r\nPOST /second HTTP/1.1\r\nHost: a\r\nContent-Length: 4\r\n\r\nab");
  (void)client.read_to("GET /first \n");
  server.transport().stop();
  std::this_thread::sleep_for(50ms);
  client.send("cd");
  EXPECT_THAT(client.read_all(), EndsWith("POST /second abcd\n"));
  server.stop();
  EXPECT_EQ(server.transport().gauges().connections, 0u);
}

TEST(Transport, TwoServersCannotShareAPort) {
  RunningTransport server;
  try {
    const Transport second({.port = server.port()}, [](const auto&) {});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("Address already in use"));
  }
}

}  // namespace
}  // namespace qdot::server
