// The shortest decimals against those of the standard library, which finds them in another way (Ryu).

#include "api/json/shortest_decimal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace qdot::api {
namespace {

/// d.ddde+xx
std::string written(const Decimal& decimal) {
  std::string digits = std::to_string(decimal.digits);
  const int exponent = decimal.exponent + static_cast<int>(digits.size()) - 1;
  if (digits.size() > 1) digits.insert(1, ".");
  const std::string size = std::to_string(std::abs(exponent));
  return digits + (exponent < 0 ? "e-" : "e+") + (size.size() < 2 ? "0" : "") + size;
}

std::string by_the_library(double value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr};
}

void expect_same(const std::vector<double>& values) {
  for (const double value : values) {
    if (!(value > 0 && std::isfinite(value))) continue;
    ASSERT_EQ(written(shortest_decimal(value)), by_the_library(value));
  }
}

TEST(ShortestDecimal, OfNumbersOfEverySizeIsTheLibrarys) {
  std::mt19937_64 bits(1);
  std::vector<double> values;
  for (int i = 0; i < 300'000; ++i) values.push_back(std::abs(std::bit_cast<double>(bits())));
  expect_same(values);
}

TEST(ShortestDecimal, OfPowersOfTwoAndTenAndTheirNeighboursIsTheLibrarys) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> values;
  const auto add = [&](double x) {
    values.insert(values.end(), {std::nextafter(x, 0), x, std::nextafter(x, infinite)});
  };
  for (int e = -1074; e < 1024; ++e) add(std::ldexp(1.0, e));
  for (int e = -307; e < 309; ++e) add(std::pow(10.0, e));
  expect_same(values);
}

TEST(ShortestDecimal, OfTimesAndWholeNumbersAndFractionsIsTheLibrarys) {
  std::mt19937_64 bits(2);
  std::vector<double> values;
  for (int i = 0; i < 50'000; ++i) {
    values.insert(values.end(), {i * 0.1, i / 1000.0, 100.0 * i / 999, i * 1e5});
    const std::uint64_t any = bits();
    values.push_back(std::ldexp(static_cast<double>(any >> any % 64), -static_cast<int>(any % 77)));
  }
  expect_same(values);
}

TEST(ShortestDecimal, HasNoZeroAtItsEnd) {
  for (const double value : {1.0, 10.0, 1e15, 1e22, 4e300, 0.5, 123456000.0}) {
    EXPECT_NE(shortest_decimal(value).digits % 10, 0U) << value;
  }
}

}  // namespace
}  // namespace qdot::api
