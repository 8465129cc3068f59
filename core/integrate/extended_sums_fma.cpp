#include "core/integrate/extended_sums.hpp"
#include "core/numerics/four_double_doubles.hpp"

namespace qdot::extended_sums::fma {

#include "core/integrate/extended_sums_body.hpp"

}  // namespace qdot::extended_sums::fma
