#pragma once
// cpp-httplib as the engine that puts an answer into HTTP: its dispatch, its status line and header fields,
// and its gzip. Sockets, framing and lanes are ours; their headers say why.
//
// httplib (0.11.4) does not see the client's bytes. Where framing.hpp refuses, its parser takes the first of
// two lengths. Where the contract has an answer, it says 400: to an unknown method, a second "?", a field of
// more than 8 KiB. And it decodes "%41" in a field's value, so that a bearer token would become another one.
// So the framing passes on what it has read, as far as the form of the answer depends on it.

#include <string_view>

#include "api/http/messages.hpp"
#include "server/outgoing.hpp"

namespace qdot::server {

/// What decides the form of an answer.
struct Form {
  std::string_view method{};
  std::string_view accept_encoding{};
  Follow follow{Follow::close};
};

/// Compresses 200s of 1 KiB and more for clients that accept gzip; the same text always becomes the same
/// bytes. A header field whose value holds a line end is left out. Throws std::bad_alloc, and nothing else.
[[nodiscard]] Outgoing to_http(api::Response response, const Form& form);

}  // namespace qdot::server
