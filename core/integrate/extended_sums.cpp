#include "core/integrate/extended_sums.hpp"

#include "core/numerics/instruction_set.hpp"

namespace qdot {

void sum_rows(const ExtendedRows& rows, ExtendedSum of, const DoubleDouble& s, std::span<DoubleDouble> sums) {
  static const bool has_fma = has_avx2_and_fma();
  (has_fma ? extended_sums::fma::sum_rows : extended_sums::plain::sum_rows)(rows, of, s, sums.data(),
                                                                            sums.size());
}

}  // namespace qdot
