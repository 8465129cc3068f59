// The sums, included once for each instruction set inside a namespace of its own.

namespace {

constexpr std::size_t lanes = 4;

/// Coefficients k of four rows.
[[gnu::always_inline]] inline FourDoubles highs(const DoubleDouble* const* rows, std::size_t k) {
  return FourDoubles{rows[0][k].high, rows[1][k].high, rows[2][k].high, rows[3][k].high};
}
[[gnu::always_inline]] inline FourDoubleDoubles whole(const DoubleDouble* const* rows, std::size_t k) {
  return {highs(rows, k), FourDoubles{rows[0][k].low, rows[1][k].low, rows[2][k].low, rows[3][k].low}};
}
[[gnu::always_inline]] inline FourDoubles four_times(double x) { return FourDoubles{x, x, x, x}; }

template <ExtendedSum of>
[[gnu::always_inline]] inline FourDoubleDoubles sum_four(const DoubleDouble* const* rows, const Rows& of_rows,
                                                         const DoubleDouble& at) {
  const FourDoubleDoubles s{four_times(at.high), four_times(at.low)};
  std::size_t k = of_rows.order + 1;
  FourDoubles tail{};
  while (k > of_rows.first_in_doubles) {
    --k;
    const FourDoubles c = highs(rows, k);
    tail = tail * s.high + (of == ExtendedSum::slope ? four_times(static_cast<double>(k)) * c : c);
  }
  FourDoubleDoubles sum{tail, {}};
  while (k > 1) {
    --k;
    const FourDoubleDoubles c = whole(rows, k), factor{four_times(static_cast<double>(k)), {}};
    sum = sum * s + (of == ExtendedSum::slope ? factor * c : c);
  }
  return of == ExtendedSum::slope ? sum : sum * s;
}

template <ExtendedSum of>
void sum_all(const Rows& rows, const DoubleDouble& s, DoubleDouble* sums, std::size_t count) {
  for (std::size_t i = 0; i < count; i += lanes) {
    const DoubleDouble* four[lanes];
    for (std::size_t j = 0; j < lanes; ++j)
      four[j] = rows.c + (i + j < count ? i + j : count - 1) * (rows.order + 1);
    const FourDoubleDoubles sum = sum_four<of>(four, rows, s);
    for (std::size_t j = 0; j < lanes && i + j < count; ++j) sums[i + j] = {sum.high[j], sum.low[j]};
  }
}

}  // namespace

void sum_rows(const Rows& rows, ExtendedSum of, const DoubleDouble& s, DoubleDouble* sums,
              std::size_t count) {
  of == ExtendedSum::slope ? sum_all<ExtendedSum::slope>(rows, s, sums, count)
                           : sum_all<ExtendedSum::value>(rows, s, sums, count);
}
