#pragma once
// Content-Encoding: gzip (RFC 1952), for clients that ask for it.

#include <string>
#include <string_view>

namespace qdot::server {

/// Does Accept-Encoding want gzip? "gzip;q=0" says no; "*" stands for all that are not named.
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

/// The same text has the same bytes: the header has neither time nor name.
[[nodiscard]] std::string gzipped(std::string_view text);

}  // namespace qdot::server
