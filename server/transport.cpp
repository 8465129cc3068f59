// The library is Debian's cpp-httplib 0.11.4. It listens, accepts and hands out sockets. It does not read
// requests here: its reader bounds neither lines nor header counts nor chunked bodies, and lets one request's
// body become the next request (CVE-2025-53628, -52887, -46728, CVE-2026-34441). connection.cpp does that.
#include "server/transport.hpp"

#include <httplib.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "api/problem.hpp"

// Without the flags of `pkg-config --cflags cpp-httplib` all this compiles and then corrupts memory.
static_assert(sizeof(httplib::Request) == 608, "compile with the flags of pkg-config cpp-httplib 0.11.4");

namespace qdot::server {
namespace {

constexpr int listen_backlog = 1024;  // the library's 5 makes a burst of clients wait for SYN retries

/// The library's queue of accepted sockets, with the one thing that its own lacks: whether anybody waits.
class Workers final : public httplib::TaskQueue {
 public:
  Workers(int count, std::atomic<int>& waiting) : waiting_(waiting) {
    for (int i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
  }

  void enqueue(std::function<void()> task) override {
    ++waiting_;
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    changed_.notify_one();
  }

  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
    threads_.clear();  // joins
  }

 private:
  void work() {
    for (;;) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return closed_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      const auto task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      --waiting_;
      task();
    }
  }

  std::atomic<int>& waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool closed_{false};
  std::vector<std::jthread> threads_;
};

void reuse_address_only(int socket) {
  // The library's default, SO_REUSEPORT, lets two servers share one port without an error.
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

struct Transport::Impl final : httplib::Server {
  Impl(const TransportOptions& options, server::Handler handler) : handler_(std::move(handler)) {
    set_tcp_nodelay(true);
    set_socket_options(reuse_address_only);
    new_task_queue = [this, count = options.connections] { return new Workers(count, waiting_); };
    errno = 0;
    port_ = options.port == 0 ? bind_to_any_port(options.host)
                              : (bind_to_port(options.host, options.port) ? options.port : -1);
    if (port_ <= 0 || ::listen(svr_sock_, listen_backlog) != 0) {
      throw std::runtime_error("cannot listen on " + options.host + ":" + std::to_string(options.port) +
                               ": " + (errno ? std::strerror(errno) : "no such address"));
    }
  }

  void stop_soon() {
    stopping_ = true;
    // The library forgets a stop() that comes before its loop runs.
    while (!is_running() && !finished_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stop();
  }

  void serve() {
    const bool ended_well = listen_after_bind();
    finished_ = true;
    if (!ended_well) throw std::runtime_error("the listening socket failed");
  }

  int port_{-1};

 private:
  // The library calls this on a worker thread for each accepted socket.
  bool process_and_close_socket(socket_t socket) override {
    Connection connection(socket);
    try {
      const auto give_way = [this] { return stopping_ || waiting_ > 0; };
      do {
        if (!connection.wait_for_request(give_way)) break;
      } while (exchange(connection));
    } catch (const std::exception&) {
      // No memory even for an error: this client is cut off, the others go on.
    }
    return true;
  }

  bool exchange(Connection& connection) {
    const auto incoming = connection.read_request();
    if (!incoming) return false;
    const auto response = answer(*incoming);
    // When more connections are open than threads, each request waits its turn: none may keep its thread.
    const bool last = !connection.reusable() || stopping_ || waiting_ > 0;
    connection.write_response(response, last);
    return !last && connection.reusable();
  }

  api::Response answer(const Incoming& incoming) const {
    try {
      return handler_(incoming);
    } catch (...) {
      return api::to_response({.detail = "An exception reached the transport."}, "");
    }
  }

  server::Handler handler_;
  std::atomic<int> waiting_{0};
  std::atomic<bool> stopping_{false};
  std::atomic<bool> finished_{false};
};

Transport::Transport(const TransportOptions& options, Handler handler)
    : impl_(std::make_unique<Impl>(options, std::move(handler))) {}
Transport::~Transport() = default;
int Transport::port() const { return impl_->port_; }
void Transport::run() { impl_->serve(); }
void Transport::stop() { impl_->stop_soon(); }

}  // namespace qdot::server
