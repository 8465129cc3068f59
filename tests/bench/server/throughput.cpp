// Small answers on keep-alive connections: this server beside bare cpp-httplib with TCP_NODELAY, which gives
// each connection a thread of its own. Both answer with the same api::Service, in one process, in turns.
//   server_bench [connections] [seconds]

#include <arpa/inet.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "api/service.hpp"
#include "server/application.hpp"
#include "server/transport.hpp"

namespace {

using namespace qdot;
using Clock = std::chrono::steady_clock;

const std::string question =
    "GET /v1/modes?system=cart_pendulum HTTP/1.1\r\nHost: localhost\r\nConnection: keep-alive\r\n\r\n";

int connect_to(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) std::abort();
  return socket;
}

/// Asks again and again on one connection; the number of answers.
long ask_until(int port, Clock::time_point end) {
  const int socket = connect_to(port);
  std::vector<char> answer(1 << 16);
  long count = 0;
  for (; Clock::now() < end; ++count) {
    if (::send(socket, question.data(), question.size(), MSG_NOSIGNAL) < 0) break;
    // Every answer ends in "}\n", and no answer has that before.
    std::size_t size = 0;
    while (size < 2 || answer[size - 1] != '\n' || answer[size - 2] != '}') {
      const auto got = ::recv(socket, answer.data() + size, answer.size() - size, 0);
      if (got <= 0) return count;
      size += static_cast<std::size_t>(got);
    }
  }
  ::close(socket);
  return count;
}

double rate(int port, int connections, double seconds) {
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  std::atomic<long> total{0};
  {
    std::vector<std::jthread> clients;
    for (int i = 0; i < connections; ++i) clients.emplace_back([&] { total += ask_until(port, end); });
  }
  return static_cast<double>(total) / seconds;
}

double rate_of_qdot(const api::Service& service, int connections, double seconds) {
  server::RequestLog log(-1);
  server::Metrics metrics;
  server::Application* application = nullptr;
  server::Transport transport({.port = 0}, [&](const auto& exchange) { application->handle(exchange); });
  server::Application it({.lanes = {.threads = static_cast<int>(std::thread::hardware_concurrency())},
                          .hosts = {.port = transport.port()}},
                         {.answer = [&](const api::Request& request) { return service.handle(request); },
                          .appraise = [&](const api::Request& request) { return service.appraise(request); }},
                         log, metrics);
  application = &it;
  std::thread poller([&] { transport.run(); });
  const double result = rate(transport.port(), connections, seconds);
  transport.stop();
  poller.join();
  return result;
}

double rate_of_httplib(const api::Service& service, int connections, double seconds) {
  httplib::Server bare;
  bare.set_tcp_nodelay(true);
  bare.set_keep_alive_max_count(1'000'000'000);
  bare.new_task_queue = [connections] {
    return new httplib::ThreadPool(static_cast<std::size_t>(connections));
  };
  bare.Get("/v1/modes", [&](const httplib::Request& request, httplib::Response& response) {
    const auto answer = service.handle({.method = "GET", .target = request.target});
    response.set_content(answer.body, answer.content_type.c_str());
  });
  const int port = bare.bind_to_any_port("127.0.0.1");
  std::thread listener([&] { bare.listen_after_bind(); });
  while (!bare.is_running()) std::this_thread::yield();
  const double result = rate(port, connections, seconds);
  bare.stop();
  listener.join();
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const int connections = argc > 1 ? std::atoi(argv[1]) : 8;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 2;
  const api::Service service;
  (void)service.handle({.method = "GET", .target = "/v1/modes?system=cart_pendulum"});
  std::vector<double> ours, theirs;
  for (int round = 0; round < 5; ++round) {
    ours.push_back(rate_of_qdot(service, connections, seconds));
    theirs.push_back(rate_of_httplib(service, connections, seconds));
  }
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  };
  std::printf("%d connections: qdot %.0f/s, bare httplib %.0f/s, ratio %.2f\n", connections, median(ours),
              median(theirs), median(ours) / median(theirs));
}
