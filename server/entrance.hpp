#pragma once
// Where clients come in: the sockets that listen, and what becomes of a client where the process has no
// descriptor left for it or the system no memory.

#include <functional>
#include <optional>
#include <string>

#include "server/poller.hpp"

namespace qdot::server {

class Entrance {
 public:
  /// Ids from this one on are free for connections.
  static constexpr Id first_free = 3;

  /// Listens at once, or throws what listen_on throws. Without a port there is no TCP, without a path no Unix
  /// socket. Keeps the reference.
  Entrance(const Poller& poller, const std::string& host, std::optional<int> port,
           const std::string& unix_path);
  ~Entrance() { close(); }
  Entrance(const Entrance&) = delete;
  Entrance& operator=(const Entrance&) = delete;

  [[nodiscard]] int port() const { return port_; }  ///< 0 if there is no TCP
  [[nodiscard]] bool is_open() const { return tcp_ || unix_; }
  [[nodiscard]] static bool is_of(Id id) { return id < first_free; }

  /// Gives the clients who wait at this one to `admit`. Where there is no descriptor, `give_way` frees one,
  /// or else the client gets an answer that says so.
  void accept_all(Id id, const std::function<void(Descriptor)>& admit, const std::function<bool()>& give_way);

  /// The system had no memory for another connection: nobody is accepted until resume().
  [[nodiscard]] bool is_paused() const { return paused_; }
  void resume();

  void close();

 private:
  void turn_away(const Descriptor& listener);
  void pause();

  const Poller& poller_;
  Descriptor spare_, tcp_, unix_;
  std::string unix_path_;
  int port_{0};
  bool paused_{false};
};

}  // namespace qdot::server
