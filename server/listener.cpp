#include "server/listener.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace qdot::server {
namespace {

constexpr int backlog = 1024;

[[noreturn]] void cannot_listen(const std::string& where, const std::string& why) {
  throw CannotListen("cannot listen on " + where + ": " + why);
}

Descriptor listening(const addrinfo& address) {
  Descriptor socket(
      ::socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, address.ai_protocol));
  if (!socket) return socket;
  const int yes = 1;
  // A server that was killed can be started again at once.
  ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (::bind(socket.get(), address.ai_addr, address.ai_addrlen) != 0 || ::listen(socket.get(), backlog) != 0)
    return Descriptor();
  return socket;
}

sockaddr_un unix_address(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path) {
    cannot_listen(path, "a path of 1 to " + std::to_string(sizeof address.sun_path - 1) + " bytes is needed");
  }
  path.copy(address.sun_path, path.size());
  return address;
}

bool answers(const sockaddr_un& address) {
  const Descriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  return ::connect(probe.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ||
         errno != ECONNREFUSED;
}

void remove_left_over(const std::string& path, const sockaddr_un& address) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return;
  if (!S_ISSOCK(found.st_mode)) cannot_listen(path, "it exists and is not a socket");
  if (answers(address)) cannot_listen(path, std::strerror(EADDRINUSE));
  ::unlink(path.c_str());
}

}  // namespace

Descriptor listen_on(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  const std::string where = host + " port " + std::to_string(port);
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found); error != 0)
    cannot_listen(where, ::gai_strerror(error));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
  for (const auto* address = addresses.get(); address != nullptr; address = address->ai_next) {
    if (auto socket = listening(*address)) return socket;
  }
  const char* const advice = errno == EADDRINUSE ? "; another program has it: --port 0 takes a free one" : "";
  cannot_listen(where, std::strerror(errno) + std::string(advice));
}

int port_of(const Descriptor& listener) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  ::getsockname(listener.get(), reinterpret_cast<sockaddr*>(&address), &length);
  const auto port = address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                                                  : reinterpret_cast<const sockaddr_in&>(address).sin_port;
  return ntohs(port);
}

Descriptor listen_on_unix(const std::string& path) {
  const auto address = unix_address(path);
  remove_left_over(path, address);
  Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  // The mode has to be right from the first moment; a chmod would come too late.
  const auto before = ::umask(0177);
  const bool bound =
      socket && ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::umask(before);
  if (!bound || ::listen(socket.get(), backlog) != 0) cannot_listen(path, std::strerror(errno));
  return socket;
}

}  // namespace qdot::server
