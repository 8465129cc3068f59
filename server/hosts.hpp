#pragma once
// Who may ask through a browser. A page of any site can make a browser send requests to 127.0.0.1: under its
// own origin, or, by pointing its own name at this machine, under that name ("DNS rebinding"). The first is
// told by Origin, the second by Host.

#include <string>
#include <string_view>
#include <vector>

namespace qdot::server {

struct HostsOptions {
  std::string bound{"127.0.0.1"};      ///< the address that the server listens on
  int port{0};                         ///< its port; 0 if there is none
  std::vector<std::string> allowed{};  ///< more names: "name" with any port, or "name:port"
};

class Hosts {
 public:
  explicit Hosts(const HostsOptions& options);

  /// On a loopback address, or where names are listed: localhost, 127.0.0.1, [::1] and the bound address,
  /// with our port or none, and the listed names. Elsewhere we cannot know our names, so any will do.
  [[nodiscard]] bool allow(std::string_view host) const;

  /// Whether allow() refuses anybody.
  [[nodiscard]] bool are_checked() const { return restricted_; }

  /// The same site ("http://" + Host), or one of the names above with our port.
  [[nodiscard]] bool allow_origin(std::string_view origin, std::string_view host) const;

 private:
  enum class Port { exact, or_none };
  [[nodiscard]] bool lists(std::string_view authority, Port port) const;

  std::vector<std::string> own_;     ///< names that need our port beside them
  std::vector<std::string> listed_;  ///< names as they were listed
  std::string port_;
  bool restricted_;
};

}  // namespace qdot::server
