#include "core/compile/extended/kernels.hpp"
#include "core/numerics/four_double_doubles.hpp"

namespace qdot::extended::plain {

#include "core/compile/extended/kernels_body.hpp"

}  // namespace qdot::extended::plain
