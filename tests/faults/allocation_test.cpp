// Fails the n-th allocation of a whole request, for n from its first byte to its answer: the client
// gets the right answer, or a 503, or a closed connection, and the next request is answered as if nothing had
// been. A program of its own, because it replaces operator new.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "api/service.hpp"
#include "server/application.hpp"
#include "server/transport.hpp"

namespace {

std::atomic<long> until_failure{0};  // 0: none fails

void* allocated(std::size_t size) {
  if (until_failure.load(std::memory_order_relaxed) > 0 && --until_failure == 0) return nullptr;
  return std::malloc(size == 0 ? 1 : size);
}

}  // namespace

// Not inlined, because the compiler would see free() meet what came from new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* memory = allocated(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  if (until_failure.load(std::memory_order_relaxed) > 0 && --until_failure == 0) throw std::bad_alloc();
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace qdot::server {
namespace {

/// A client that allocates nothing: a failure has to hit the server.
class Client {
 public:
  /// The status of one request on a connection of its own; 0 when the connection ended without an answer.
  int ask(int port, std::string_view request) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    size_ = 0;
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
        ::send(socket, request.data(), request.size(), MSG_NOSIGNAL) > 0) {
      for (ssize_t got = 0; (got = ::recv(socket, bytes_.data() + size_, bytes_.size() - size_, 0)) > 0;)
        size_ += static_cast<std::size_t>(got);
    }
    ::close(socket);
    return size_ < 12 ? 0 : std::atoi(bytes_.data() + 9);
  }
  [[nodiscard]] std::string_view body() const {
    const std::string_view answer(bytes_.data(), size_);
    const auto end = answer.find("\r\n\r\n");
    return end == answer.npos ? std::string_view() : answer.substr(end + 4);
  }

 private:
  std::array<char, 1 << 16> bytes_;
  std::size_t size_{0};
};

std::string post(const std::string& path, const std::string& body) {
  return "POST " + path +
         " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nAccept-Encoding: gzip;q=0\r\n" +
         "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

class FailedAllocations : public testing::TestWithParam<std::string> {};

TEST_P(FailedAllocations, CostOneRequestAtMost) {
  const api::Service service;
  RequestLog log(-1);
  Metrics metrics;
  Application* application = nullptr;
  Transport transport({.port = 0}, [&](const auto& exchange) { application->handle(exchange); });
  std::optional<Application> it(
      std::in_place, ApplicationOptions{.lanes = {.threads = 1}},
      ApplicationParts{.answer = [&](const api::Request& request) { return service.handle(request); },
                       .appraise = [&](const api::Request& request) { return service.appraise(request); }},
      log, metrics);
  application = &*it;
  std::thread poller([&] { transport.run(); });

  Client client;
  const std::string request = GetParam();
  const int expected_status = client.ask(transport.port(), request);
  const std::string expected(client.body());
  ASSERT_TRUE(expected_status == 200 || expected_status == 422) << expected;
  int failures = 0;
  // Every n up to 256, then ever fewer; QDOT_EVERY_ALLOCATION in the environment: every one.
  const bool every = std::getenv("QDOT_EVERY_ALLOCATION") != nullptr;
  for (long n = 1;; n += every ? 1 : 1 + n / 256) {
    until_failure = n;
    const int status = client.ask(transport.port(), request);
    const bool failed = until_failure.exchange(0) == 0;
    failures += failed ? 1 : 0;
    ASSERT_TRUE(status == expected_status || status == 503 || (failed && status == 0))
        << status << " at " << n;
    ASSERT_EQ(client.ask(transport.port(), request), expected_status) << "after " << n;
    ASSERT_EQ(client.body(), expected) << "after " << n;
    if (!failed) break;
  }
  EXPECT_GT(failures, 50);
  transport.stop();
  poller.join();
}

const std::string ladder = R"json({"name": "ladder", "parameters": [{"name": "m", "unit": "kg", "default": 8},
  {"name": "l", "unit": "m", "default": 3}, {"name": "g", "unit": "m/s^2", "default": 9.81}],
  "coordinates": [{"name": "theta", "unit": "rad", "initial": 0.1}], "gravity": ["0", "-g"],
  "bodies": [{"kind": "rod", "mass": "m", "start": ["0", "l*cos(theta)"], "end": ["l*sin(theta)", "0"]}]})json";

INSTANTIATE_TEST_SUITE_P(
    Requests, FailedAllocations,
    testing::Values(post("/v1/simulate", R"({"system": "cart_pendulum", "t_end": 1, "samples": 3})"),
                    post("/v1/energy", R"({"system": "spring_pendulum"})"),
                    post("/v1/modes", R"({"system": "rod_pendulum"})"),
                    post("/v1/equations", R"({"system": )" + ladder + "}"),
                    post("/v1/simulate", R"({"system": "spring_pendulum", "t_end": "1 kg", "kk": 1})")));

}  // namespace
}  // namespace qdot::server
