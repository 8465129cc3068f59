#pragma once
// The parts of HTTP that the contract needs and that have no sockets: addresses, queries and media types
// (RFC 3986, RFC 9110).

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace qdot::api {

/// A request's address: "/v1/energy?system=spring_pendulum&theta=30deg".
struct Target {
  std::string path{};  ///< decoded, "/v1/energy"
  /// Decoded, in the order sent, names twice if sent twice: the reader of a request refuses those.
  std::vector<std::pair<std::string, std::string>> query{};
};

/// No value when a % is not followed by two hexadecimal digits, or when what comes out is not UTF-8 or has a
/// NUL. In the query a + is a space, as forms have it (and curl --data-urlencode, Python's requests,
/// URLSearchParams); a + itself is sent as %2B.
[[nodiscard]] std::optional<Target> parse_target(std::string_view target);

/// The first of `offered` that the Accept header wants most (RFC 9110, 12.5.1: the most specific range
/// decides about a type, the highest q among the types, the order of `offered` between equals). An empty
/// header accepts anything. nullptr: none can be sent.
[[nodiscard]] const std::string* negotiated(std::string_view accept, std::span<const std::string> offered);

enum class BodyType { json, unsupported };

/// May a body be read as JSON? Yes without Content-Type, and under application/json, text/json and
/// application/*+json, in UTF-8. `curl -d` says application/x-www-form-urlencoded of whatever it sends, so a
/// body that begins with { is JSON there too.
[[nodiscard]] BodyType body_type(std::string_view content_type, std::string_view body);

/// A strong entity tag (RFC 9110, 8.8.3) for exactly these bytes: FNV-1a, 64 bits, in quotes. Not for
/// security.
[[nodiscard]] std::string entity_tag(std::string_view body);

/// Does If-None-Match name this entity tag?
[[nodiscard]] bool matches_entity_tag(std::string_view if_none_match, std::string_view tag);

}  // namespace qdot::api
