#include "core/compile/taylor_kernels.hpp"

namespace qdot::taylor::avx2 {

#include "core/compile/taylor_kernels_body.hpp"

}  // namespace qdot::taylor::avx2
