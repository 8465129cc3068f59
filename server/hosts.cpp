#include "server/hosts.hpp"

#include <algorithm>

#include "api/json/text.hpp"

namespace qdot::server {
namespace {

using api::lower_case;

struct Authority {
  std::string name;  ///< an IPv6 address keeps its brackets
  std::string port;
};

Authority split(std::string_view text) {
  const auto bracket = text.rfind(']');
  const auto colon = text.find(':', bracket == text.npos ? 0 : bracket);
  return {lower_case(text.substr(0, colon)),
          colon == text.npos ? std::string() : std::string(text.substr(colon + 1))};
}

bool is_loopback(std::string_view host) {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

}  // namespace

Hosts::Hosts(const HostsOptions& options)
    : own_{"localhost", "127.0.0.1", "[::1]"},
      port_(options.port > 0 ? std::to_string(options.port) : std::string()),
      restricted_(is_loopback(lower_case(options.bound)) || !options.allowed.empty()) {
  const auto bound = lower_case(options.bound);
  own_.push_back(bound.find(':') == bound.npos ? bound : "[" + bound + "]");
  for (const auto& name : options.allowed) listed_.push_back(lower_case(name));
}

bool Hosts::lists(std::string_view authority, Port port) const {
  const auto [name, given] = split(authority);
  const auto here = [&](const auto& names, const std::string& text) {
    return std::ranges::find(names, text) != names.end();
  };
  if (here(listed_, name) || here(listed_, name + ":" + given)) return true;
  const bool right_port = port_.empty() || given == port_ || (given.empty() && port == Port::or_none);
  return right_port && here(own_, name);
}

bool Hosts::allow(std::string_view host) const { return !restricted_ || lists(host, Port::or_none); }

bool Hosts::allow_origin(std::string_view origin, std::string_view host) const {
  const auto text = lower_case(origin);
  const auto scheme = text.find("://");
  if (scheme == text.npos) return false;  // "null": a page that hides where it is from
  const auto authority = std::string_view(text).substr(scheme + 3);
  return authority == lower_case(host) || (restricted_ && lists(authority, Port::exact));
}

}  // namespace qdot::server
