#pragma once
// One client's socket, as a state that moves on when there is something to read or to write and never waits.
// All of it runs on the poller's thread. It is ours because httplib gives each connection a thread, which a
// silent client then holds: its time limit begins anew with each byte.

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "server/budget.hpp"
#include "server/descriptor.hpp"
#include "server/exchange.hpp"
#include "server/message_reader.hpp"
#include "server/outgoing.hpp"

namespace qdot::server {

/// How long a client may take.
struct Patience {
  Clock::duration head{std::chrono::seconds(5)};  ///< from the first to the last byte of a head
  Clock::duration request{
      std::chrono::seconds(8)};  ///< from the first to the last byte of a request; also until a first byte
  Clock::duration idle{std::chrono::seconds(60)};   ///< between two requests
  Clock::duration write{std::chrono::seconds(10)};  ///< for each 64 KiB of an answer
  Clock::duration crowded{
      std::chrono::seconds(2)};  ///< for an answer, while too many bytes of answers wait to be read
  Clock::duration linger{std::chrono::seconds(1)};  ///< for a refused client to read why
  Clock::duration farewell{
      std::chrono::milliseconds(50)};  ///< after it stopped sending, until it counts as gone
};

class Connection {
 public:
  enum class State {
    waiting,    ///< nothing of a request has arrived
    reading,    ///< a part of one has
    answering,  ///< somebody works on the answer; the socket is left alone
    writing,    ///< the rest of an answer goes out
    lingering,  ///< all is said; what the client still sends is read and thrown away
    closed
  };

  /// `bodies` bounds the memory of all clients' large bodies together.
  Connection(Descriptor socket, const Patience& patience, Budget& bodies, Clock::time_point now);

  [[nodiscard]] int socket() const { return socket_.get(); }
  [[nodiscard]] State state() const { return state_; }

  /// Takes note of what epoll reported; each event is reported once.
  void note(std::uint32_t events, Clock::time_point now);

  /// Moves on as far as it can. Whoever gets a request from it has to deliver() an answer.
  [[nodiscard]] std::optional<Incoming> advance(Clock::time_point now);

  /// Ends what has taken longer than Patience allows; returns the same as advance().
  [[nodiscard]] std::optional<Incoming> expire(Clock::time_point now);

  /// The exchange that works on the request that advance() returned: it learns when the client leaves.
  void await(const std::shared_ptr<Exchange>& exchange) { exchange_ = exchange; }
  /// Whether another request may follow the one that was returned last.
  [[nodiscard]] Follow follow() const { return follow_; }
  /// True while the client has sent something that the next advance() would use. It outlives the connection,
  /// because the thread that answers looks at it.
  [[nodiscard]] const std::shared_ptr<std::atomic<bool>>& has_more() const { return has_more_; }
  /// Takes the answer, of which a part may have been sent already.
  void deliver(Outgoing outgoing, Clock::time_point now);

  /// Tells the client that there is no room for it, and reads no request.
  void turn_away(Clock::time_point now);
  /// Ends the connection, whatever it was doing. While somebody works on an answer it must not be called.
  void close();
  /// True when the client has not read its answer in the time that it has where answers crowd.
  [[nodiscard]] bool is_in_the_way(Clock::time_point now) const {
    return state_ == State::writing && now - answered_ > patience_.crowded;
  }
  /// True when the client has been reading its answer since then, or for longer.
  [[nodiscard]] bool is_read_since(Clock::time_point then) const {
    return state_ == State::writing && answered_ <= then;
  }
  /// True when the client has taken nothing of it for as long.
  [[nodiscard]] bool takes_nothing(Clock::time_point now) const {
    return state_ == State::writing && now - took_ > patience_.crowded;
  }
  [[nodiscard]] std::size_t unsent() const { return outgoing_.unsent(); }
  /// True when the client has stopped sending and it is not yet clear whether it has left.
  [[nodiscard]] bool leaving() const { return state_ == State::answering && gone_at_.has_value(); }

 private:
  std::optional<Incoming> read(Clock::time_point now);
  std::optional<Incoming> take_request(Clock::time_point now);
  void write(Clock::time_point now);
  std::size_t count_taken(Clock::time_point now);
  void discard();
  void wait_for_next(Clock::time_point now);
  void linger(Clock::time_point now);
  Incoming begin(Incoming incoming);

  Descriptor socket_;
  const Patience& patience_;
  Budget& bodies_;
  State state_{State::waiting};
  Clock::time_point deadline_;
  Clock::time_point begun_{};     // when the first byte of the request came
  Clock::time_point answered_{};  // when the answer was there
  Clock::time_point took_{};      // when the client was last seen to take some of it
  MessageReader reader_;
  Outgoing outgoing_;
  std::optional<Budget::Share> body_share_;
  std::weak_ptr<Exchange> exchange_;
  std::optional<Clock::time_point> gone_at_;
  std::size_t written_{0};    // bytes of the answer that the client had when the deadline was set
  std::size_t taken_{0};      // and when they were counted last
  std::size_t discarded_{0};  // while lingering
  Follow follow_{Follow::close};
  bool fresh_{true};     // no request has come yet
  bool refused_{false};  // what follows cannot be framed
  bool readable_{true};
  std::shared_ptr<std::atomic<bool>> has_more_{std::make_shared<std::atomic<bool>>(false)};
  bool head_seen_{false};
};

}  // namespace qdot::server
