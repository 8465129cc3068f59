#include "core/integrate/extended_sums.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace qdot {
namespace {

constexpr unsigned sum_order = 32;

/// By Horner's rule, one row and one double-double after the other.
DoubleDouble one_by_one(const DoubleDouble* c, unsigned first_in_doubles, ExtendedSum of,
                        const DoubleDouble& s) {
  const auto factor = [of](unsigned k) { return of == ExtendedSum::slope ? static_cast<double>(k) : 1.0; };
  unsigned k = sum_order + 1;
  double tail = 0;
  while (k > first_in_doubles) {
    --k;
    tail = tail * s.high + factor(k) * c[k].high;
  }
  DoubleDouble sum = tail;
  while (k > 1) {
    --k;
    sum = sum * s + (of == ExtendedSum::slope ? DoubleDouble(factor(k)) * c[k] : c[k]);
  }
  return of == ExtendedSum::slope ? sum : sum * s;
}

void expect_same(const std::vector<DoubleDouble>& sums, const std::vector<DoubleDouble>& expected) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    EXPECT_EQ(sums[i].high, expected[i].high) << i;
    EXPECT_EQ(sums[i].low, expected[i].low) << i;
  }
}

TEST(ExtendedSums, OfAnyNumberOfRowsHaveTheBitsOfEachAloneWithAndWithoutFusedMultiplyAdds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const std::size_t count : {1, 2, 4, 6, 9}) {
    for (const double size : {1.0, 1e-160, 1e150}) {
      std::vector<DoubleDouble> c;
      for (std::size_t i = 0; i < count * (sum_order + 1); ++i) {
        const double high = size * uniform(random);
        c.push_back({high, 0x1p-54 * high * uniform(random)});
      }
      const DoubleDouble s{0.71 * uniform(random), 1e-17};
      for (const unsigned first_in_doubles : {6U, ~0U}) {
        for (const ExtendedSum of : {ExtendedSum::value, ExtendedSum::slope}) {
          const ExtendedRows rows{c.data(), sum_order, first_in_doubles};
          std::vector<DoubleDouble> expected, sums(count), plain(count);
          for (std::size_t i = 0; i < count; ++i)
            expected.push_back(one_by_one(&c[i * (sum_order + 1)], first_in_doubles, of, s));
          sum_rows(rows, of, s, sums);
          expect_same(sums, expected);
          extended_sums::plain::sum_rows(rows, of, s, plain.data(), count);
          expect_same(plain, expected);
        }
      }
    }
  }
}

}  // namespace
}  // namespace qdot
