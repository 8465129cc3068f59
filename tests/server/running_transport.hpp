#pragma once
// A transport that runs in a thread of its own, and clients that say what well-behaved ones would not.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/engine.hpp"
#include "server/transport.hpp"

namespace qdot::server {

/// Echoes method, target and body; a refusal's status comes back as it is.
inline api::Response echo(const Incoming& incoming) {
  if (const auto* refusal = std::get_if<Refusal>(&incoming)) {
    return {api::problem_type(refusal->kind).status, "text/plain", {}, "refused\n"};
  }
  const auto& request = std::get<api::Request>(incoming);
  if (request.target == "/throw") throw std::runtime_error("secret");
  return {200, "text/plain", {}, request.method + " " + request.target + " " + request.body + "\n"};
}

using Answering = std::function<api::Response(const Incoming&)>;

/// Answers each request in a thread of its own.
class RunningTransport {
 public:
  explicit RunningTransport(Answering answer = echo, TransportOptions options = {.port = 0})
      : transport_(options, [this, answer](const auto& exchange) { begin(answer, exchange); }),
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
  void begin(const Answering& answer, const std::shared_ptr<Exchange>& exchange) {
    answering_.emplace_back([answer, exchange] {
      try {
        exchange->answer(to_http(answer(exchange->incoming), {.method = "GET", .follow = exchange->follow}));
      } catch (const std::runtime_error&) {
        // Then nobody answers it.
      }
    });
  }

  std::vector<std::jthread> answering_;  // the poller's alone
  Transport transport_;
  std::thread thread_;
};

inline constexpr const char* loopback = "127.0.0.1";

/// A client that says what a well-behaved one would not: half a request, two at once.
class RawClient {
 public:
  explicit RawClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~RawClient() { ::close(socket_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

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

  std::string read_large() const {
    std::string bytes;
    std::vector<char> part(1 << 16);
    for (ssize_t count = 0; (count = ::recv(socket_, part.data(), part.size(), 0)) > 0;)
      bytes.append(part.data(), static_cast<std::size_t>(count));
    return bytes;
  }
  /// At most so many bytes, as soon as there are some.
  std::string read_part(std::size_t size) const {
    std::string bytes(size, ' ');
    const auto count = ::recv(socket_, bytes.data(), size, 0);
    bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return bytes;
  }
  std::size_t read_some(std::size_t size) const {
    std::vector<char> part(size);
    const auto count = ::recv(socket_, part.data(), part.size(), MSG_DONTWAIT);
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  void stop_sending() const { ::shutdown(socket_, SHUT_WR); }

 private:
  int socket_;
};

}  // namespace qdot::server
