#include "api/json/shortest_decimal.hpp"

#include <array>
#include <bit>
#include <cstddef>

namespace qdot::api {
namespace {

using Wide = unsigned __int128;

constexpr int bits_of_fraction = 52;
constexpr int least_power = -292, largest_power = 324;  ///< of ten
constexpr std::size_t powers = largest_power - least_power + 1;

/// A number of 64 bits above the point of 64 more.
struct Power {
  std::uint64_t high{}, low{};
};

/// Whole numbers of 1088 bits, the lowest 32 first.
using Big = std::array<std::uint32_t, 34>;

constexpr void multiply(Big& x, std::uint32_t factor) {
  std::uint64_t carry = 0;
  for (std::uint32_t& part : x) {
    carry += std::uint64_t{part} * factor;
    part = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
}

constexpr void divide(Big& x, std::uint32_t divisor) {
  std::uint64_t rest = 0;
  for (std::size_t i = x.size(); i-- > 0;) {
    rest = rest << 32 | x[i];
    x[i] = static_cast<std::uint32_t>(rest / divisor);
    rest %= divisor;
  }
}

/// 64 bits from so many above the lowest; what lies below it is 0.
constexpr std::uint64_t bits_at(const Big& x, int place) {
  std::uint64_t bits = 0;
  for (int i = 0; i < 64; ++i) {
    const int at = place + i;
    if (at < 0) continue;
    const auto part = static_cast<std::size_t>(at / 32);
    if (part < x.size()) bits |= std::uint64_t{x[part] >> (at % 32) & 1} << i;
  }
  return bits;
}

constexpr int highest_bit(const Big& x) {
  std::size_t part = x.size() - 1;
  while (x[part] == 0) --part;
  return static_cast<int>(32 * part) + std::bit_width(x[part]) - 1;
}

/// The leading 128 bits.
constexpr Power leading(const Big& x) {
  const int highest = highest_bit(x);
  return {bits_at(x, highest - 63), bits_at(x, highest - 127)};
}

constexpr Power next(const Power& power) { return {power.high + (power.low + 1 == 0), power.low + 1}; }

/// 10^k over the power of two that leaves 1 <= .. < 2, times 2^127 and rounded up: the digits of 5^k, and of
/// 2^1087/5^-k, which is never whole.
constexpr std::array<Power, powers> table_of_powers() {
  std::array<Power, powers> table;
  Big rising{1}, falling{};
  falling.back() = 0x8000'0000;
  for (int k = 0; k <= largest_power; ++k, multiply(rising, 5)) {
    constexpr int exact = 55;  // 5^55 < 2^128
    const Power power = leading(rising);
    table[static_cast<std::size_t>(k - least_power)] = k <= exact ? power : next(power);
  }
  for (int k = -1; k >= least_power; --k) {
    divide(falling, 5);
    table[static_cast<std::size_t>(k - least_power)] = next(leading(falling));
  }
  return table;
}

constexpr std::array<Power, powers> power_of_ten = table_of_powers();

constexpr int floor_log2_of_power_of_ten(int k) { return (k * 1'741'647) >> 19; }

/// floor(x g / 2^128), its last bit set where something was cut off.
std::uint64_t product(const Power& g, std::uint64_t x) {
  const Wide low = Wide{g.low} * x, high = Wide{g.high} * x + static_cast<std::uint64_t>(low >> 64);
  return static_cast<std::uint64_t>(high >> 64) | (static_cast<std::uint64_t>(high) > 1 ? 1 : 0);
}

/// c 2^q; its lower neighbour is half as far as the upper one where c is a power of two.
Decimal shortest(std::uint64_t c, int q, bool lower_is_closer) {
  const int k = (q * 1'262'611 - (lower_is_closer ? 524'031 : 0)) >> 22;
  const int shift = q + floor_log2_of_power_of_ten(-k) + 1;
  const Power& g = power_of_ten[static_cast<std::size_t>(-k - least_power)];
  // Four times the number, and the middles to its neighbours; these are read back as it where c is even.
  const std::uint64_t open = c % 2;
  const std::uint64_t lower = product(g, (4 * c - 2 + (lower_is_closer ? 1 : 0)) << shift) + open;
  const std::uint64_t here = product(g, 4 * c << shift);
  const std::uint64_t upper = product(g, (4 * c + 2) << shift) - open;
  const std::uint64_t s = here / 4;
  if (s >= 10) {
    const std::uint64_t tens = s / 10;
    const bool below = lower <= 40 * tens, above = 40 * tens + 40 <= upper;
    if (below != above) return {tens + (above ? 1 : 0), k + 1};
  }
  const bool below = lower <= 4 * s, above = 4 * s + 4 <= upper;
  if (below != above) return {s + (above ? 1 : 0), k};
  const std::uint64_t middle = 4 * s + 2;
  const bool up = here > middle || (here == middle && s % 2 == 1);
  return {s + (up ? 1 : 0), k};
}

Decimal without_zeros(Decimal decimal) {
  while (decimal.digits % 10 == 0) decimal = {decimal.digits / 10, decimal.exponent + 1};
  return decimal;
}

}  // namespace

Decimal shortest_decimal(double value) {
  constexpr std::uint64_t hidden = std::uint64_t{1} << bits_of_fraction;
  constexpr int bias = 1023 + bits_of_fraction;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t fraction = bits % hidden;
  const int exponent = static_cast<int>(bits >> bits_of_fraction);
  if (exponent == 0) return without_zeros(shortest(fraction, 1 - bias, false));
  const std::uint64_t c = hidden | fraction;
  const int q = exponent - bias;
  const bool is_whole = q <= 0 && q > -bits_of_fraction - 1 && c % (std::uint64_t{1} << -q) == 0;
  if (is_whole) return without_zeros({c >> -q, 0});
  return without_zeros(shortest(c, q, fraction == 0 && exponent > 1));
}

}  // namespace qdot::api
