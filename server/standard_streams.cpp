#include "server/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace qdot::server {

void keep_closed_standard_streams() {
  int descriptor = 0;
  // Of O_PATH there is nothing to read or to write; and /, unlike /dev/null, takes no answers by /dev/stdout.
  do descriptor = ::open("/", O_PATH);
  while (descriptor >= 0 && descriptor <= STDERR_FILENO);
  if (descriptor > STDERR_FILENO) ::close(descriptor);
}

}  // namespace qdot::server
