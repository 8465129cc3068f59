#include <immintrin.h>

#include "core/compile/extended/kernels.hpp"

namespace qdot::extended::fma {

#include "core/compile/extended/kernels_body.hpp"

}  // namespace qdot::extended::fma
