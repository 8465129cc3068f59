#include "core/compile/taylor_kernels.hpp"

namespace qdot::taylor::plain {

#include "core/compile/taylor_kernels_body.hpp"

}  // namespace qdot::taylor::plain
