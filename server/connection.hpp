#pragma once
// One client's socket, as a state that moves on when there is something to read or to write and never waits.
// All of it runs on the poller's thread.

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
  Clock::duration head{std::chrono::seconds(5)};  ///< first to last byte of a head
  Clock::duration request{
      std::chrono::seconds(8)};                    ///< first to last byte of a request; also for a first byte
  Clock::duration idle{std::chrono::seconds(60)};  ///< between two requests
  Clock::duration write{std::chrono::seconds(10)};          ///< for each 64 KiB of an answer
  Clock::duration linger{std::chrono::seconds(1)};          ///< to read why it was refused
  Clock::duration farewell{std::chrono::milliseconds(50)};  ///< from its end of sending to its leaving
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

  /// `bodies` bounds what all clients' large bodies hold together.
  Connection(Descriptor socket, const Patience& patience, Budget& bodies, Clock::time_point now);

  [[nodiscard]] int socket() const { return socket_.get(); }
  [[nodiscard]] State state() const { return state_; }

  /// What epoll said, edge-triggered.
  void note(std::uint32_t events, Clock::time_point now);

  /// Moves on as far as it goes. A request that is returned has to be given to answers().
  [[nodiscard]] std::optional<Incoming> advance(Clock::time_point now);

  /// Enforces what Patience says; as advance().
  [[nodiscard]] std::optional<Incoming> expire(Clock::time_point now);

  /// The exchange that works on the request that advance() returned: it learns when the client leaves.
  void await(const std::shared_ptr<Exchange>& exchange) { exchange_ = exchange; }
  /// Whether another request may follow the one that was returned last.
  [[nodiscard]] Follow follow() const { return follow_; }
  /// Set while something of the client is here that the next advance() would use. Outlives the connection,
  /// for the thread that answers.
  [[nodiscard]] const std::shared_ptr<std::atomic<bool>>& has_more() const { return has_more_; }
  /// Its answer, in part sent perhaps.
  void deliver(Outgoing outgoing, Clock::time_point now);

  /// Says that there is no room for it, instead of reading a request.
  void turn_away(Clock::time_point now);
  /// Ends it, whatever it was doing; an answer that somebody works on has to come first.
  void close();
  /// True when the client has stopped sending and it is not yet clear whether it has left.
  [[nodiscard]] bool leaving() const { return state_ == State::answering && gone_at_.has_value(); }

 private:
  std::optional<Incoming> read(Clock::time_point now);
  std::optional<Incoming> take_request(Clock::time_point now);
  void write(Clock::time_point now);
  void discard();
  void wait_for_next(Clock::time_point now);
  void linger(Clock::time_point now);
  Incoming begin(Incoming incoming);

  Descriptor socket_;
  const Patience& patience_;
  Budget& bodies_;
  State state_{State::waiting};
  Clock::time_point deadline_;
  Clock::time_point begun_{};  // the request that is being read
  MessageReader reader_;
  Outgoing outgoing_;
  std::optional<Budget::Share> body_share_;
  std::weak_ptr<Exchange> exchange_;
  std::optional<Clock::time_point> gone_at_;
  std::size_t written_{0};    // of the answer when the deadline was set
  std::size_t discarded_{0};  // while lingering
  Follow follow_{Follow::close};
  bool fresh_{true};     // no request has come yet
  bool refused_{false};  // what follows cannot be framed
  bool readable_{true};
  std::shared_ptr<std::atomic<bool>> has_more_{std::make_shared<std::atomic<bool>>(false)};
  bool head_seen_{false};
};

}  // namespace qdot::server
