#include "core/compile/taylor/kernels.hpp"

namespace qdot::taylor::avx2 {

#include "core/compile/taylor/kernels_body.hpp"
#include "core/compile/taylor/sizes_body.hpp"

}  // namespace qdot::taylor::avx2
