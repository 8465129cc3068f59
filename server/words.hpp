#pragma once
// The words after a command as the request that a client would send: "cart_pendulum k=10" is the query
// "system=cart_pendulum&k=10".

#include <string>
#include <string_view>
#include <vector>

#include "api/json/limits.hpp"

namespace qdot::server {

/// Encoded for a place in a path or in a query (RFC 3986, 2.3: the rest is a % and two digits).
[[nodiscard]] std::string percent_encoded(std::string_view text);

/// Name and value of each word, encoded, each with & behind it. The first word may be a system's name alone.
/// Throws UsageError for a word that is no name=value.
[[nodiscard]] std::string query_of(const std::vector<std::string>& words);

/// The notation of equations that the word names, tex for latex; empty: none.
[[nodiscard]] std::string_view form_called(std::string_view word);

/// Whether the only word is the request itself, {"system": ...}.
[[nodiscard]] bool is_body(const std::vector<std::string>& words);

/// The request in a file; stdin where `file` is empty or "-". Throws UsageError where there is none, and for
/// one that is longer than `most` bytes, by default the most that a body may have.
[[nodiscard]] std::string request_body(const std::string& file,
                                       std::size_t most = api::limits::large_body_bytes);

}  // namespace qdot::server
