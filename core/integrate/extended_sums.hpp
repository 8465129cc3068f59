#pragma once
// Values and slopes of Taylor polynomials in double-doubles, four rows side by side, from the smallest terms
// on. Compiled with fused multiply-adds and without; both give the same bits.

#include <span>

#include "core/numerics/double_double.hpp"

namespace qdot {

enum class ExtendedSum {
  value,  ///< sum_{k>=1} c_k s^k
  slope   ///< sum_{k>=1} k c_k s^(k-1)
};

/// Rows of order + 1 coefficients. Those from one order on are doubles, and are added up in doubles.
struct ExtendedRows {
  const DoubleDouble* c{};
  unsigned order{}, first_in_doubles{};
};

/// Of as many rows as there are sums.
void sum_rows(const ExtendedRows& rows, ExtendedSum of, const DoubleDouble& s, std::span<DoubleDouble> sums);

namespace extended_sums {
using Rows = ExtendedRows;
namespace plain {
void sum_rows(const Rows& rows, ExtendedSum of, const DoubleDouble& s, DoubleDouble* sums, std::size_t count);
}
namespace fma {
void sum_rows(const Rows& rows, ExtendedSum of, const DoubleDouble& s, DoubleDouble* sums, std::size_t count);
}
}  // namespace extended_sums

}  // namespace qdot
