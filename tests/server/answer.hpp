#pragma once
// An answer of the server, read back.

#include <map>
#include <string>

#include "server/outgoing.hpp"

namespace qdot::server {

struct Answer {
  explicit Answer(const Outgoing& outgoing)
      : status(std::stoi(std::string(outgoing.head().substr(9, 3)))), body(outgoing.body()) {
    auto lines = outgoing.head();
    while (lines.size() > 2) {
      lines.remove_prefix(lines.find("\r\n") + 2);
      const auto line = lines.substr(0, lines.find("\r\n"));
      if (const auto colon = line.find(": "); colon != line.npos)
        headers.emplace(line.substr(0, colon), line.substr(colon + 2));
    }
  }

  int status;
  std::map<std::string, std::string> headers;
  std::string body;
};

}  // namespace qdot::server
