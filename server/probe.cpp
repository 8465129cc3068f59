#include "server/probe.hpp"

#include <httplib.h>

#include <thread>

namespace qdot::server {
namespace {

using namespace std::chrono_literals;

// The address that a server binds to is not always one that can be called.
std::string callable(const std::string& host) {
  if (host == "0.0.0.0") return "127.0.0.1";
  if (host == "::") return "::1";
  return host;
}

}  // namespace

bool healthy(const ProbeOptions& options) {
  const bool local = !options.unix_socket.empty();
  httplib::Client client(local ? options.unix_socket : callable(options.host), options.port);
  if (local) client.set_address_family(AF_UNIX);
  // Every server accepts this name, whatever its address is called here.
  client.set_default_headers({{"Host", "localhost" + (local ? "" : ":" + std::to_string(options.port))}});
  client.set_connection_timeout(options.timeout);
  client.set_read_timeout(options.timeout);
  client.set_write_timeout(options.timeout);
  const auto answer = client.Get("/healthz");
  return answer && answer->status == 200;
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
