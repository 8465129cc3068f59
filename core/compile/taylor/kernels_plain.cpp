#include "core/compile/taylor/kernels.hpp"

namespace qdot::taylor::plain {

#include "core/compile/taylor/kernels_body.hpp"
#include "core/compile/taylor/sizes_body.hpp"

}  // namespace qdot::taylor::plain
