#include "server/transport.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <list>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "server/entrance.hpp"
#include "server/poller.hpp"

namespace qdot::server {
namespace {

using namespace std::chrono_literals;
using State = Connection::State;
constexpr std::size_t overflow =
    128;  // connections beyond the bound that are still told that there is no room
constexpr std::size_t reserved_files = 24;    // descriptors that are not connections
constexpr std::size_t all_bodies = 32 << 20;  // bytes that large bodies may hold at a time
constexpr auto sweep_interval = 100ms;
constexpr auto leaving_interval = 20ms;
constexpr auto resting = 4ms;

/// As many connections as asked for, if the process may have so many descriptors.
std::size_t possible_connections(std::size_t wanted) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  const auto needed = static_cast<rlim_t>(wanted + overflow + reserved_files);
  if (files.rlim_cur < needed) {
    files.rlim_cur = std::min(files.rlim_max, needed);
    ::setrlimit(RLIMIT_NOFILE, &files);
  }
  const auto spare = static_cast<std::size_t>(std::max<rlim_t>(files.rlim_cur, reserved_files + 8));
  return std::min(wanted, spare - reserved_files);
}

}  // namespace

struct Transport::Impl {
  Impl(const TransportOptions& options, Handler handler)
      : handler_(std::move(handler)),
        patience_(options.patience),
        most_connections_(possible_connections(options.connections)),
        most_unsent_(options.unsent_bytes),
        entrance_(poller_, options.host, options.port, options.unix_socket) {
    posted_.reserve(most_connections_ + overflow);  // so that post() allocates nothing
    taken_.reserve(most_connections_ + overflow);
  }

  void run() {
    thread_ = std::this_thread::get_id();
    while (!finished()) {
      if (std::exchange(rests_, false)) std::this_thread::sleep_for(resting);
      const auto events = poller_.wait(wait_milliseconds());
      now_ = Clock::now();
      take_answers();  // before anyone is let in, because whoever was answered can give way
      for (const epoll_event& event : events) handle(event);
      take_answers();  // of the requests that were answered here
      if (stopping_) release_idle();
      sweep();
    }
  }

  void stop() {
    stopping_ = true;
    poller_.wake();
  }

  void rest() { rests_ = true; }

  [[nodiscard]] int port() const { return entrance_.port(); }
  std::atomic<std::size_t> connection_count_{0};
  Budget unsent_{~std::size_t{0}};

 private:
  struct Entry {
    Connection connection;
    std::list<Id> place;  // has one element, which is moved to waiting_ while it waits for the client
    std::list<Id>::iterator in_waiting{};
    bool waits{false};
    Budget::Share unsent{};
  };
  using Entries = std::unordered_map<Id, Entry>;

  struct Posted {
    Id id{};
    Outgoing outgoing;
    Budget::Share unsent;
  };

  [[nodiscard]] bool finished() const { return stopping_ && !entrance_.is_open() && entries_.empty(); }

  [[nodiscard]] int wait_milliseconds() const {
    if (entries_.empty() && !entrance_.is_paused()) return -1;
    return static_cast<int>((someone_leaves_ ? leaving_interval : sweep_interval) / 1ms);
  }

  void handle(const epoll_event& event) {
    const Id id = event.data.u64;
    if (Entrance::is_of(id)) {
      entrance_.accept_all(
          id, [this](Descriptor socket) { admit(std::move(socket)); }, [this] { return drop_one_waiting(); });
    } else if (const auto entry = entries_.find(id); entry != entries_.end()) {
      entry->second.connection.note(event.events, now_);
      drive(entry);
    }
  }

  // --- connections in -------------------------------------------------------------------------------------

  void admit(Descriptor socket) {
    const int yes = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const bool full = entries_.size() >= most_connections_ && !drop_one_waiting();
    if (entries_.size() >= most_connections_ + overflow) return;
    try {
      const Id id = next_id_++;
      poller_.watch(socket, id, EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET);
      const auto entry =
          entries_.try_emplace(id, Entry{Connection(std::move(socket), patience_, bodies_, now_), {id}})
              .first;
      ++connection_count_;
      // All connections are being answered, so none can give way: the newcomer gets its answer at once.
      if (full) entry->second.connection.turn_away(now_);
      drive(entry);
    } catch (const std::exception&) {
      // There is no memory for this connection. The client is cut off, and the others go on.
    }
  }

  /// Closes the connection that has waited longest for a request; false when none does.
  bool drop_one_waiting() {
    if (waiting_.empty()) return false;
    const auto entry = entries_.find(waiting_.front());
    entry->second.connection.close();
    settle(entry);
    return true;
  }

  // --- requests and answers -------------------------------------------------------------------------------

  void drive(Entries::iterator entry) {
    Connection& connection = entry->second.connection;
    try {
      if (auto incoming = connection.advance(now_)) give(*entry, std::move(*incoming));
    } catch (const std::exception&) {
      if (connection.state() != State::answering) connection.close();
    }
    settle(entry);
  }

  void give(Entries::value_type& entry, Incoming incoming) {
    Connection& connection = entry.second.connection;
    // The answering thread may use the socket, because it stays open until the answer has come.
    const auto deliver = [this, id = entry.first, socket = connection.socket(),
                          more = connection.has_more()](Outgoing outgoing) noexcept {
      outgoing.send(socket);
      // A kept connection whose answer is out has nothing to do until its client sends more, and then the
      // poller wakes anyway.
      const bool done = outgoing.unsent() == 0 && outgoing.follow() == Follow::keep_alive;
      auto unsent = unsent_.count(outgoing.unsent());
      post({.id = id, .outgoing = std::move(outgoing), .unsent = std::move(unsent)});
      if ((!done || *more || stopping_) && std::this_thread::get_id() != thread_) poller_.wake();
    };
    std::shared_ptr<Exchange> exchange;
    try {
      const auto follow = stopping_ ? Follow::close : connection.follow();
      exchange = std::make_shared<Exchange>(std::move(incoming), follow, deliver);
    } catch (const std::exception&) {
      deliver(Outgoing::out_of_memory());
      return;
    }
    connection.await(exchange);
    handler_(exchange);  // if it throws, the exchange is destroyed and answers for itself
  }

  void post(Posted posted) {
    const std::lock_guard lock(mutex_);
    posted_.push_back(std::move(posted));
  }

  void take_answers() {
    for (;;) {
      {
        const std::lock_guard lock(mutex_);
        posted_.swap(taken_);
      }
      if (taken_.empty()) return;
      for (Posted& posted : taken_) {
        const auto entry = entries_.find(posted.id);
        entry->second.unsent = std::move(posted.unsent);
        entry->second.connection.deliver(std::move(posted.outgoing), now_);
        drive(entry);
      }
      taken_.clear();
    }
  }

  /// Is called after each move of a connection. Forgets it if it is closed, and keeps waiting_ in order.
  void settle(Entries::iterator entry) {
    Entry& it = entry->second;
    const State state = it.connection.state();
    if (state != State::answering) it.unsent.shrink_to(state == State::writing ? it.connection.unsent() : 0);
    if (it.connection.leaving()) {
      someone_leaves_ = true;
      next_sweep_ = std::min(next_sweep_, now_ + leaving_interval);
    }
    const bool waits = state == State::waiting || state == State::reading || state == State::lingering;
    if (it.waits && !waits) it.place.splice(it.place.end(), waiting_, it.in_waiting);
    if (!it.waits && waits) {
      it.in_waiting = it.place.begin();
      waiting_.splice(waiting_.end(), it.place);
    }
    it.waits = waits;
    if (state != State::closed) return;
    entries_.erase(entry);
    --connection_count_;
  }

  // --- time -----------------------------------------------------------------------------------------------

  void sweep() {
    if (now_ < next_sweep_) return;
    someone_leaves_ = false;
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      const auto here = entry++;
      try {
        if (auto incoming = here->second.connection.expire(now_)) give(*here, std::move(*incoming));
      } catch (const std::exception&) {
        if (here->second.connection.state() != State::answering) here->second.connection.close();
      }
      settle(here);
    }
    if (unsent_.used() > most_unsent_) drop_one_in_the_way();
    if (entrance_.is_paused()) entrance_.resume();
    next_sweep_ = now_ + (someone_leaves_ ? leaving_interval : sweep_interval);
  }

  /// Closes, of the connections whose clients read nothing, or else slowly, the one with most to read.
  void drop_one_in_the_way() {
    const auto weight = [this](const Entry& entry) {
      return std::pair(entry.connection.takes_nothing(now_), entry.connection.unsent());
    };
    auto most = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (!entry->second.connection.is_in_the_way(now_)) continue;
      if (most == entries_.end() || weight(entry->second) > weight(most->second)) most = entry;
    }
    if (most == entries_.end()) return;
    most->second.connection.close();
    settle(most);
  }

  /// The server is about to end: only requests in flight keep their connections, and clients that still send
  /// or read, for as long as one slice of an answer may take. Probes are answered until the answers that were
  /// there before are out.
  void release_idle() {
    if (!last_moment_) last_moment_ = now_ + patience_.write;
    const bool late = now_ > *last_moment_;
    const bool one_goes_out = std::ranges::any_of(entries_, [&](const auto& entry) {
      return entry.second.connection.is_read_since(*last_moment_ - patience_.write);
    });
    const bool ends = late || !one_goes_out;
    if (ends) entrance_.close();
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      const auto here = entry++;
      const State state = here->second.connection.state();
      if ((ends && state == State::waiting) || (late && state != State::answering))
        here->second.connection.close();
      settle(here);
    }
  }

  Handler handler_;
  Patience patience_;
  std::size_t most_connections_;
  std::size_t most_unsent_;
  Budget bodies_{all_bodies};
  Poller poller_;
  Entrance entrance_;
  Clock::time_point now_{Clock::now()};
  Clock::time_point next_sweep_{};
  std::optional<Clock::time_point>
      last_moment_;  // for answers that are still going out when the server is about to end
  Entries entries_;
  std::list<Id> waiting_;
  Id next_id_{Entrance::first_free};
  std::thread::id thread_;  ///< that polls
  bool someone_leaves_{false};
  bool rests_{false};
  std::atomic<bool> stopping_{false};
  std::mutex mutex_;
  std::vector<Posted> posted_;  // filled by the threads that answer; guarded by mutex_
  std::vector<Posted> taken_;
};

Transport::Transport(const TransportOptions& options, Handler handler)
    : impl_(std::make_unique<Impl>(options, std::move(handler))) {}
Transport::~Transport() = default;
int Transport::port() const { return impl_->port(); }
void Transport::run() { impl_->run(); }
void Transport::stop() { impl_->stop(); }
void Transport::rest() { impl_->rest(); }
Transport::Gauges Transport::gauges() const {
  return {.connections = impl_->connection_count_, .unsent_bytes = impl_->unsent_.used()};
}

}  // namespace qdot::server
