// Two terms side by side are those of a loop over one at a time.

#include "core/integrate/step_terms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/numerics/random_bits.hpp"

namespace qdot {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double h = 0.37;

std::vector<double> drawn(std::size_t count, std::uint64_t seed) {
  RandomBits random(seed);
  std::vector<double> numbers(count);
  for (double& x : numbers) x = (random.fraction() - 0.5) * 8;
  return numbers;
}

double largest_one_by_one(std::span<const double> c) {
  double power = 1, largest = 0, end[2]{};
  for (std::size_t k = 0; k < c.size(); ++k) {
    largest = std::max(largest, std::abs(c[k]) * power);
    if (k + 1 < c.size() || k % 2 == 1) end[k % 2] += c[k] * power;
    power *= h;
  }
  const double last = c.size() % 2 == 1 ? c.back() * (power / h) : 0;
  return std::max(largest, std::abs(end[0] + end[1] + last));
}

TEST(StepTerms, AreTheLargestOfEachComponentAtEvenAndOddOrders) {
  for (const unsigned order : {1U, 2U, 8U, 17U, 22U}) {
    const std::vector<double> rows = drawn(4 * (order + 1), order);
    StepTerms terms(4);
    terms.take({.t = 0, .h = h, .rows = rows, .order = order});
    for (std::size_t i = 0; i < 4; ++i) {
      const auto row = std::span(rows).subspan(i * (order + 1), order + 1);
      EXPECT_EQ(terms.largest()[i], largest_one_by_one(row)) << order;
    }
  }
}

TEST(StepTerms, PassOverWhatIsNoNumber) {
  for (const std::size_t at : {0U, 3U, 8U}) {
    std::vector<double> rows = drawn(9, 5);
    rows[at] = no_number;
    StepTerms terms(1);
    terms.take({.t = 0, .h = h, .rows = rows, .order = 8});
    EXPECT_EQ(terms.largest()[0], largest_one_by_one(rows)) << at;
  }
}

TEST(StepTerms, OfDifferencesHaveTheBitsOfOneSumInTheirOrder) {
  for (const unsigned order : {7U, 8U}) {
    const std::vector<double> own = drawn(23, 1);
    const std::vector<double> before = drawn(order + 1, 2);
    std::vector<double> c = before;
    StepTerms terms(1);
    terms.take({.t = 0, .h = h, .rows = own, .order = 22});
    const auto [sum, largest] = terms.subtract(own.data(), order, 1e-3, c.data());
    double power = 1, expected = 0, most = 1e-3;
    for (unsigned k = 1; k <= order; ++k) {
      power *= h;
      const double term = (own[k] - before[k]) * power;
      EXPECT_EQ(c[k], term);
      expected += term;
      most = std::max(most, std::abs(term));
    }
    EXPECT_EQ(std::bit_cast<std::uint64_t>(sum), std::bit_cast<std::uint64_t>(expected));
    EXPECT_EQ(largest, most);
    EXPECT_EQ(c[0], before[0]);
  }
}

TEST(StepTerms, OfTwoDifferencesSideBySideAreThoseOfEach) {
  for (const unsigned order : {7U, 8U}) {
    const std::vector<double> own = drawn(23, 1);
    std::vector<double> first = drawn(order + 1, 2), second = drawn(order + 1, 3);
    second[3] = no_number;
    std::vector<PairOfDoubles> both(order + 1);
    for (unsigned k = 0; k <= order; ++k) both[k] = PairOfDoubles{first[k], second[k]};
    StepTerms terms(1);
    terms.take({.t = 0, .h = h, .rows = own, .order = 22});
    const auto [sum, largest] = terms.subtract(own.data(), order, PairOfDoubles{1e-3, 1e6}, both.data());
    const auto of_first = terms.subtract(own.data(), order, 1e-3, first.data());
    const auto of_second = terms.subtract(own.data(), order, 1e6, second.data());
    EXPECT_EQ(sum[0], of_first.sum);
    EXPECT_TRUE(std::isnan(sum[1]) && std::isnan(of_second.sum));
    EXPECT_EQ(largest[0], of_first.largest);
    EXPECT_EQ(largest[1], of_second.largest);
    for (unsigned k = 0; k <= order; ++k) {
      EXPECT_EQ(both[k][0], first[k]) << k;
      EXPECT_TRUE(both[k][1] == second[k] || k == 3) << k;
    }
  }
}

}  // namespace
}  // namespace qdot
