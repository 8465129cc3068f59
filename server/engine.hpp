#pragma once
// cpp-httplib as the engine that says an answer in HTTP: its dispatch, its status line and header fields,
// HEAD and gzip. Sockets, framing and lanes are ours; their headers say why.
//
// httplib does not see the client's bytes. Where framing.hpp refuses, its parser (0.11.4) takes the first of
// two lengths; where the contract has an answer, it says 400 to an unknown method, a second "?" and a field
// over 8 KiB, and it decodes "%41" in field values, so that a bearer token would become another one. It is
// given what the framing has read.

#include "api/service.hpp"
#include "server/exchange.hpp"
#include "server/outgoing.hpp"

namespace qdot::server {

/// The response to what `incoming` asked. Compresses 200s of 1 KiB and more for clients that accept gzip: the
/// same text always becomes the same bytes. A field whose value holds a line end is left out. Throws
/// std::bad_alloc, and nothing else.
[[nodiscard]] Outgoing to_http(api::Response response, const Incoming& incoming, Follow follow);

}  // namespace qdot::server
