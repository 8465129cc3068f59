#pragma once
// Values of Taylor polynomials at four times side by side: one for each lane, with the bits of
// sum_all_series() (core/integrate/series_sums.hpp) at each of them.

#include <cstddef>
#include <span>

namespace qdot {

/// What rows of `order` + 1 coefficients add up to from order 1 on at times s[0] to s[3]: row by row, four
/// values of each.
void sum_series_at_four(const double* c, std::size_t order, const double* s, std::span<double> sums);

/// The same without AVX2, whatever the processor has.
void sum_series_at_four_plainly(const double* c, std::size_t order, const double* s, std::span<double> sums);

}  // namespace qdot
