#include "core/compile/extended/kernels.hpp"

namespace qdot::extended::plain {

#include "core/compile/extended/kernels_body.hpp"

}  // namespace qdot::extended::plain
