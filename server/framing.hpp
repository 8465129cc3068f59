#pragma once
// How a request is framed (RFC 9112), read strictly: what two readers could understand differently is
// refused. A pure function of bytes, so that every rule can be tested without a socket. It is ours because
// httplib 0.11.4 takes the first of two lengths, skips lines that are no fields, and bounds neither line nor
// head.

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "api/http/problem.hpp"
#include "api/json/limits.hpp"

namespace qdot::server {

inline constexpr std::size_t max_body_bytes = api::limits::large_body_bytes;
inline constexpr std::size_t max_head_bytes = std::size_t{1} << 14;
inline constexpr std::size_t max_target_bytes = std::size_t{1} << 13;
inline constexpr std::size_t max_fields = 64;

/// Why a request goes no further than its framing. The connection closes after the answer, because where the
/// next request would begin is not known.
struct Refusal {
  api::ProblemKind kind{};
  std::string detail;
  std::string method;  ///< as far as it was read
  std::string target;
};

/// Everything before the body.
struct Head {
  std::string method;
  std::string target;                         ///< origin form, "/v1/energy?system=..."
  std::map<std::string, std::string> fields;  ///< names in lower case; repeated fields joined by ", "
  std::size_t content_length{0};
  bool keep_alive{true};         ///< the client would send another request
  bool expects_continue{false};  ///< the body comes after "100 Continue"
};

/// One past the empty line that ends the head; npos while it is incomplete.
[[nodiscard]] std::size_t head_end(std::string_view bytes);

/// `bytes` is one whole head, its empty line included.
[[nodiscard]] std::variant<Head, Refusal> read_head(std::string_view bytes);

/// The refusal of a head that passes max_head_bytes without an end.
[[nodiscard]] Refusal oversized_head(std::string_view bytes);

}  // namespace qdot::server
