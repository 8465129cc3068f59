#pragma once
// The answer to a request for which there is no room. Under ten times the load nine of ten answers are this
// one, and each is written on the processor that the tenth is computed on: its text is formed once an
// address, and then only what differs from request to request is put in.

#include <string>
#include <string_view>
#include <unordered_map>

#include "server/outgoing.hpp"

namespace qdot::server {

class Refusals {
 public:
  struct Asked {
    std::string_view method{};
    std::string_view path{};
    Follow follow{Follow::close};
  };
  /// 503 `overloaded`; Retry-After says `seconds`. Throws std::bad_alloc, and nothing else.
  [[nodiscard]] Outgoing answer(const Asked& asked, std::string_view request_id, std::string_view seconds);

 private:
  struct Text {
    std::string until_seconds{}, until_id{}, until_body{}, body{};
  };
  const Text& text(const Asked& asked);
  std::unordered_map<std::string, Text> texts_;
};

}  // namespace qdot::server
