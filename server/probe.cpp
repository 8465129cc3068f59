#include "server/probe.hpp"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>

#include <array>
#include <memory>
#include <string_view>
#include <thread>

#include "server/descriptor.hpp"

namespace qdot::server {
namespace {

using namespace std::chrono_literals;

// The address that a server binds to is not always one that can be called.
std::string callable(const std::string& host) {
  if (host == "0.0.0.0") return "127.0.0.1";
  if (host == "::") return "::1";
  return host;
}

bool says_ok(int socket, const std::string& authority) {
  const auto request =
      "GET /healthz HTTP/1.1\r\nHost: " + authority + "\r\nAccept: */*\r\nConnection: close\r\n\r\n";
  if (::send(socket, request.data(), request.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(request.size())) {
    return false;
  }
  std::array<char, 12> status{};  // "HTTP/1.1 200"
  const auto count = ::recv(socket, status.data(), status.size(), MSG_WAITALL);
  return count == 12 && std::string_view(status.data(), 12).substr(8) == " 200";
}

bool answers(const sockaddr* address, socklen_t length, const std::string& authority,
             std::chrono::milliseconds timeout) {
  const Descriptor socket(::socket(address->sa_family, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!socket) return false;
  const timeval limit{timeout / 1s, (timeout % 1s) / 1us};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);  // of connect(), too
  ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  return ::connect(socket.get(), address, length) == 0 && says_ok(socket.get(), authority);
}

bool answers_on_unix(const ProbeOptions& options) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (options.unix_socket.size() >= sizeof address.sun_path) return false;
  options.unix_socket.copy(address.sun_path, options.unix_socket.size());
  return answers(reinterpret_cast<const sockaddr*>(&address), sizeof address, "localhost", options.timeout);
}

}  // namespace

bool healthy(const ProbeOptions& options) {
  if (!options.unix_socket.empty()) return answers_on_unix(options);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const auto port = std::to_string(options.port);
  if (::getaddrinfo(callable(options.host).c_str(), port.c_str(), &hints, &found) != 0) return false;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
  for (const auto* address = addresses.get(); address; address = address->ai_next) {
    if (answers(address->ai_addr, address->ai_addrlen, "localhost:" + port, options.timeout)) return true;
  }
  return false;
}

bool wait_until_healthy(const ProbeOptions& options, std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!healthy(options)) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(100ms);
  }
  return true;
}

}  // namespace qdot::server
