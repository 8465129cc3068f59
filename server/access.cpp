#include "server/access.hpp"

#include "api/json/text.hpp"

namespace qdot::server {
namespace {

std::string_view field(const api::Request& request, const std::string& name) {
  const auto found = request.headers.find(name);
  return found == request.headers.end() ? std::string_view() : std::string_view(found->second);
}

// The time it takes does not tell where two texts of one length differ.
bool equal_in_constant_time(std::string_view given, std::string_view expected) {
  if (given.size() != expected.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    difference |= static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(expected[i]);
  }
  return difference == 0;
}

}  // namespace

bool is_probe(std::string_view path) { return path == "/healthz" || path == "/livez" || path == "/readyz"; }

bool Access::has_token(const api::Request& request) const {
  constexpr std::string_view scheme = "bearer ";
  const auto given = field(request, "authorization");
  return api::lower_case(given.substr(0, scheme.size())) == scheme &&
         equal_in_constant_time(api::trimmed(given.substr(scheme.size())), token_);
}

std::optional<api::ProblemKind> Access::refusal(const api::Request& request) const {
  const auto host = field(request, "host");
  // Only HTTP/1.0 may come without Host, and no browser speaks it.
  if (request.headers.contains("host") && !hosts_.allow(host)) return api::ProblemKind::misdirected_request;
  if (request.headers.contains("origin") && !hosts_.allow_origin(field(request, "origin"), host))
    return api::ProblemKind::forbidden_origin;
  const std::string_view path = std::string_view(request.target).substr(0, request.target.find('?'));
  if (!token_.empty() && !is_probe(path) && !has_token(request)) return api::ProblemKind::unauthorized;
  return std::nullopt;
}

}  // namespace qdot::server
