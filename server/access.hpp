#pragma once
// Who may ask: the names in Host and Origin (hosts.hpp), and the bearer token where one is set.

#include <optional>
#include <string>
#include <string_view>

#include "api/http/messages.hpp"
#include "api/http/problem.hpp"
#include "server/hosts.hpp"

namespace qdot::server {

/// Is it /healthz, /livez or /readyz? These tell nothing that needs a token.
[[nodiscard]] bool is_probe(std::string_view path);

class Access {
 public:
  /// An empty token lets everybody in; any other is asked for as RFC 6750 says.
  Access(const HostsOptions& hosts, std::string token) : hosts_(hosts), token_(std::move(token)) {}

  /// Why the request is refused, if it is: misdirected_request, forbidden_origin or unauthorized.
  [[nodiscard]] std::optional<api::ProblemKind> refusal(const api::Request& request) const;

 private:
  [[nodiscard]] bool has_token(const api::Request& request) const;

  Hosts hosts_;
  std::string token_;
};

}  // namespace qdot::server
