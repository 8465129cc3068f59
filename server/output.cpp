#include "server/output.hpp"

#include <cerrno>
#include <string>
#include <system_error>

namespace qdot::server {

void refuse_to_lose(std::string_view what) {
  const std::string reason = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  throw CannotWrite("cannot write " + std::string(what) + reason);
}

void write_out(std::ostream& stream, std::string_view text) {
  errno = 0;
  stream << text << std::flush;
  if (!stream) refuse_to_lose("the answer");
}

}  // namespace qdot::server
