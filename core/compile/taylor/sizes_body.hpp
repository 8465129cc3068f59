// How large rows are, four of them side by side, included after kernels_body.hpp once for each instruction
// set.

namespace {

using Bits [[gnu::vector_size(32)]] = std::uint64_t;
using Flags [[gnu::vector_size(32)]] = std::int64_t;

constexpr std::uint64_t without_sign = ~(std::uint64_t{1} << 63);

/// Magnitudes of so many of four numbers; 0 for the others, which may be no numbers.
constexpr std::uint64_t masks[5][4]{{0, 0, 0, 0},
                                    {without_sign, 0, 0, 0},
                                    {without_sign, without_sign, 0, 0},
                                    {without_sign, without_sign, without_sign, 0},
                                    {without_sign, without_sign, without_sign, without_sign}};

[[gnu::always_inline]] inline Four magnitudes(const Four& x, unsigned count) {
  Bits mask;
  __builtin_memcpy(&mask, masks[count], sizeof mask);
  return reinterpret_cast<Four>(reinterpret_cast<Bits>(x) & mask);
}

[[gnu::always_inline]] inline Four larger(const Four& x, const Four& y) { return x > y ? x : y; }
[[gnu::always_inline]] inline Four smaller(const Four& x, const Four& y) { return x < y ? x : y; }

/// Sums and largest of |c_k| g^k, k >= 1, still in four parts.
[[gnu::always_inline]] inline void weigh(const RowSizes& row, const double* powers, Four& sum, Four& most) {
  const double* c = row.coefficients;
  const unsigned degree = row.degree;
  sum = most = Four{};
  unsigned k = 1;
  for (; k + 3 <= degree; k += 4) {
    const Four x = magnitudes(load(c + k) * load(powers + k), 4);
    sum += x;
    most = larger(x, most);
  }
  if (k > degree) return;
  const Four x = magnitudes(load(c + k) * load(powers + k), degree - k + 1);
  sum += x;
  most = larger(x, most);
}

/// Numbers 0 and 2 of x and y in turn, and numbers 1 and 3.
[[gnu::always_inline]] inline Four evens(const Four& x, const Four& y) {
  return __builtin_shufflevector(x, y, 0, 4, 2, 6);
}
[[gnu::always_inline]] inline Four odds(const Four& x, const Four& y) {
  return __builtin_shufflevector(x, y, 1, 5, 3, 7);
}
[[gnu::always_inline]] inline Four firsts(const Four& x, const Four& y) {
  return __builtin_shufflevector(x, y, 0, 1, 4, 5);
}
[[gnu::always_inline]] inline Four seconds(const Four& x, const Four& y) {
  return __builtin_shufflevector(x, y, 2, 3, 6, 7);
}

/// The four parts of four rows become one number for each.
[[gnu::always_inline]] inline Four sums_of(const Four* part) {
  const Four x = evens(part[0], part[1]) + odds(part[0], part[1]);
  const Four y = evens(part[2], part[3]) + odds(part[2], part[3]);
  return firsts(x, y) + seconds(x, y);
}
[[gnu::always_inline]] inline Four largest_of(const Four* part) {
  const Four x = larger(evens(part[0], part[1]), odds(part[0], part[1]));
  const Four y = larger(evens(part[2], part[3]), odds(part[2], part[3]));
  return larger(firsts(x, y), seconds(x, y));
}

/// a u + b u^2 for 0 <= u <= 1 is between these. An extremum a u/2 inside, at u = -a/(2b), is no farther than
/// a/2: no branch and no quotient.
[[gnu::always_inline]] inline void parabola(const Four& a, const Four& b, Four& least, Four& most) {
  const Four size_a = magnitudes(a, 4), size_b = magnitudes(b, 4);
  const Flags has_extremum = (size_a < size_b + size_b) & ((a < 0) ^ (b < 0));
  const Four extremum = reinterpret_cast<Four>(reinterpret_cast<Flags>(0.5 * a) & has_extremum);
  const Four end = a + b, zero{};
  least = smaller(extremum, smaller(end, zero));
  most = larger(extremum, larger(end, zero));
}

[[gnu::always_inline]] inline void measure_four(RowSizes* const* rows, const SizeScales& scales) {
  Four sum[4], most[4], begin[4];
#pragma GCC unroll 4
  for (unsigned i = 0; i < 4; ++i) {
    weigh(*rows[i], scales.powers, sum[i], most[i]);
    begin[i] = load(rows[i]->coefficients);
  }
  const Four norm = sums_of(sum);
  const Four peak = smaller(largest_of(most) * scales.beyond, norm);
  const Four x = evens(begin[0], begin[1]), y = evens(begin[2], begin[3]);
  const Four c0 = firsts(x, y), c2 = seconds(x, y);
  const Four c1 = firsts(odds(begin[0], begin[1]), odds(begin[2], begin[3]));
  const Four a = c1 * scales.h, b = c2 * scales.h2, t3 = scales.rho3 * peak;
  const Four t2 = t3 + magnitudes(b, 4);
  const Four t0 = t2 + magnitudes(a, 4) + magnitudes(c0, 4);
  const Four rest = t3 + scales.rounding * t0;
  Four lower, upper;
  parabola(a, b, lower, upper);
  lower = lower - rest + c0;
  upper = upper + rest + c0;
#pragma GCC unroll 4
  for (unsigned i = 0; i < 4; ++i) {
    RowSizes& row = *rows[i];
    row.norm = norm[i];
    row.peak = peak[i];
    row.t2 = t2[i];
    row.t0 = t0[i];
    row.lower = lower[i];
    row.upper = upper[i];
  }
}

}  // namespace

void measure(RowSizes* const* rows, unsigned count, const SizeScales& scales) {
  for (unsigned i = 0; i < count; i += 4) measure_four(rows + i, scales);
}
