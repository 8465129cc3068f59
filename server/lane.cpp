#include "server/lane.hpp"

#include <sys/resource.h>
#include <unistd.h>

namespace qdot::server {

void lower_priority() { ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), heavy_niceness); }

}  // namespace qdot::server
