#include "server/serve.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "api/service.hpp"
#include "server/application.hpp"
#include "server/transport.hpp"

namespace qdot::server {
namespace {

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

/// The thread that the first signal wakes to end the server, while a second one is awaited by another.
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
                 SIGTERM);  // when no signal ended the server, it still waits for one
    thread_.join();
  }

  Ending(const Ending&) = delete;
  Ending& operator=(const Ending&) = delete;

 private:
  std::thread thread_;
};

void announce(const std::string& host, int port) {
  const auto name = host.find(':') == host.npos ? host : "[" + host + "]";
  const nlohmann::ordered_json line{{"listening", "http://" + name + ":" + std::to_string(port)},
                                    {"port", port}};
  std::puts(line.dump().c_str());
  std::fflush(stdout);
}

}  // namespace

void serve(const ServeOptions& options) {
  // Blocked here, and so in every thread that starts later: only wait_for_signal() takes them.
  const auto signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  const api::Service service({.scenes_directory = options.scenes});
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = options.threads > 0 ? options.threads : cores;
  Application application({.lanes = {.threads = threads}, .log = stderr},
                          [&](const api::Request& request) { return service.handle(request); });
  Transport transport({.host = options.host, .port = options.port},
                      [&](const std::shared_ptr<Exchange>& exchange) { application.handle(exchange); });
  const Ending ending(application, transport);
  announce(options.host, transport.port());
  transport.run();
}

}  // namespace qdot::server
