#include "server/entrance.hpp"

#include <fcntl.h>
#include <sys/socket.h>

#include <cerrno>

#include "server/listener.hpp"
#include "server/outgoing.hpp"

namespace qdot::server {
namespace {

constexpr Id tcp_id = 1;
constexpr Id unix_id = 2;

Descriptor spare_descriptor() { return Descriptor(::open("/dev/null", O_RDONLY | O_CLOEXEC)); }

Descriptor accept_one(const Descriptor& listener) {
  return Descriptor(::accept4(listener.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
}

}  // namespace

Entrance::Entrance(const Poller& poller, const std::string& host, std::optional<int> port,
                   const std::string& unix_path)
    : poller_(poller), spare_(spare_descriptor()) {
  if (port) {
    tcp_ = listen_on(host, *port);
    port_ = port_of(tcp_);
  }
  if (!unix_path.empty()) {
    unix_ = listen_on_unix(unix_path);
    unix_path_ = unix_path;
  }
  resume();
}

void Entrance::accept_all(Id id, const std::function<void(Descriptor)>& admit,
                          const std::function<bool()>& give_way) {
  const Descriptor& listener = id == tcp_id ? tcp_ : unix_;
  for (int i = 0; i < 64; ++i) {
    Descriptor socket = accept_one(listener);
    if (socket) {
      admit(std::move(socket));
    } else if (errno == EMFILE || errno == ENFILE) {
      if (!give_way()) turn_away(listener);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return;
    } else if (errno != EINTR && errno != ECONNABORTED) {
      return pause();
    }
  }
}

/// There is no descriptor left. The spare one serves to tell the client.
void Entrance::turn_away(const Descriptor& listener) {
  spare_.reset();
  if (const Descriptor socket = accept_one(listener)) Outgoing::out_of_memory().send(socket.get());
  spare_ = spare_descriptor();
}

void Entrance::pause() {
  paused_ = true;
  for (const auto* listener : {&tcp_, &unix_}) {
    if (*listener) poller_.forget(*listener);
  }
}

void Entrance::resume() {
  paused_ = false;
  if (tcp_) poller_.watch(tcp_, tcp_id, EPOLLIN);
  if (unix_) poller_.watch(unix_, unix_id, EPOLLIN);
}

void Entrance::close() {
  tcp_.reset();
  if (unix_) ::unlink(unix_path_.c_str());
  unix_.reset();
}

}  // namespace qdot::server
