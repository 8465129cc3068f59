#include "server/serve.hpp"

#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <thread>

#include "api/contract/version.hpp"
#include "api/json/documents.hpp"
#include "api/service.hpp"
#include "server/application.hpp"
#include "server/hosts.hpp"
#include "server/processors.hpp"
#include "server/transport.hpp"
#include "server/web/pages.hpp"

namespace qdot::server {
namespace {

constexpr int default_port = 8080;

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT}) sigaddset(&signals, signal);
  return signals;
}

int wait_for_signal() {
  const auto signals = ending_signals();
  int signal = 0;
  sigwait(&signals, &signal);
  return signal;
}

/// A thread that waits for the first signal and then ends the server; another waits for a second signal
/// meanwhile.
class Ending {
 public:
  Ending(Application& application, Transport& transport)
      : thread_([&] {
          wait_for_signal();
          std::thread([] { _exit(128 + wait_for_signal()); }).detach();
          application.drain();
          transport.stop();
        }) {}

  ~Ending() {
    pthread_kill(thread_.native_handle(),
                 SIGTERM);  // if no signal has come, the thread still waits for one
    thread_.join();
  }

  Ending(const Ending&) = delete;
  Ending& operator=(const Ending&) = delete;

 private:
  std::thread thread_;
};

std::string address_of(const std::string& host, int port) {
  const auto name = host.find(':') == host.npos ? host : "[" + host + "]";
  return "http://" + name + ":" + std::to_string(port);
}

void announce(const ServeOptions& options, int port) {
  api::Json line = api::Json::object();
  line["listening"] = options.port ? address_of(options.host, port) : "unix:" + options.unix_socket;
  if (options.port) line["port"] = port;
  if (!options.unix_socket.empty()) line["unix_socket"] = options.unix_socket;
  std::puts(api::dump_json(line).c_str());
  std::fflush(stdout);
}

/// Logs the settings in force, with the defaults. The token itself is never logged.
void log_configuration(RequestLog& log, const ServeOptions& options, const TransportOptions& transport) {
  log.write_event("start", {{"version", api::service_version()},
                            {"host", options.host},
                            {"port", options.port ? api::Json(*options.port) : api::Json(nullptr)},
                            {"unix_socket", options.unix_socket},
                            {"threads", options.threads},
                            {"deadline", options.deadline},
                            {"allowed_hosts", options.allowed_hosts},
                            {"token", !options.token.empty()},
                            {"scenes", options.scenes},
                            {"connections", transport.connections}});
}

/// Makes the allocator give memory back after a large answer, and lets threads share what they have freed.
/// But they must not share too much: where a thread of low priority is stopped while it holds the lock of an
/// arena, light work that needs this arena waits until the thread goes on. So there is about one for each
/// thread of the lanes on a small machine.
void keep_memory_small() {
  ::mallopt(M_MMAP_THRESHOLD, 256 * 1024);
  ::mallopt(M_TRIM_THRESHOLD, 1024 * 1024);
  ::mallopt(M_ARENA_MAX, 16);
}

ServeOptions with_defaults(ServeOptions options) {
  if (!options.port && options.unix_socket.empty()) options.port = default_port;
  if (options.threads <= 0) options.threads = usable_processors();
  return options;
}

Gauges gauges_of(const Application& application, const Transport& transport) {
  const auto sockets = transport.gauges();
  Gauges now{.connections = sockets.connections,
             .unsent_bytes = sockets.unsent_bytes,
             .draining = application.draining()};
  for (const Lane lane : all_lanes)
    now.lanes[static_cast<std::size_t>(lane)] = application.lanes().gauges(lane);
  return now;
}

}  // namespace

void serve(const ServeOptions& given) {
  ServeOptions options = with_defaults(given);
  // Signals are blocked in this thread, and so in each that it starts: only wait_for_signal() takes them.
  const auto signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  keep_memory_small();

  RequestLog log(STDERR_FILENO);
  Metrics metrics;
  Application* application = nullptr;
  const TransportOptions addresses{
      .host = options.host, .port = options.port, .unix_socket = options.unix_socket};
  // The port must be known first, because the names that Host may have depend on it.
  Transport transport(addresses,
                      [&](const std::shared_ptr<Exchange>& exchange) { application->handle(exchange); });
  if (options.port) options.port = transport.port();
  const api::Service service(
      {.scenes_directory = options.scenes,
       .metrics = [&] { return metrics.text(gauges_of(*application, transport), log.dropped()); },
       .pages = web::pages()});
  Application it(
      {.lanes = {.threads = options.threads},
       .hosts = {.bound = options.host, .port = options.port.value_or(0), .allowed = options.allowed_hosts},
       .token = options.token,
       .deadline =
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.deadline))},
      {.answer = [&](const api::Request& request) { return service.handle(request); },
       .appraise = [&](const api::Request& request) { return service.appraise(request); },
       .unsent_bytes = [&] { return transport.gauges().unsent_bytes; },
       .overloaded = [&] { transport.rest(); }},
      log, metrics);
  application = &it;
  const Ending ending(it, transport);
  log_configuration(log, options, addresses);
  if (!Hosts({.bound = options.host, .port = 0, .allowed = options.allowed_hosts}).are_checked()) {
    log.write_event("host_unchecked",
                    {{"detail", "On " + options.host +
                                    " any Host is answered, so that a page of any "
                                    "site can ask through a browser. --allowed-hosts with this "
                                    "service's names ends that."}});
  }
  announce(options, transport.port());
  transport.run();
  log.write_event("end", api::Json::object());
}

}  // namespace qdot::server
