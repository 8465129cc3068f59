#include "core/expr/number.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <new>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/rational.hpp"

namespace qdot {

struct Number::Large {
  mpq_class value;
};

namespace {

// GMP ends the program where there is no memory. Its functions in C have the tables by which an exception
// passes.
void* allocate(std::size_t bytes) {
  if (void* const memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void* reallocate(void* memory, std::size_t, std::size_t bytes) {
  if (void* const moved = std::realloc(memory, bytes)) return moved;
  throw std::bad_alloc();
}
void release(void* memory, std::size_t) { std::free(memory); }
[[maybe_unused]] const bool throws = (mp_set_memory_functions(allocate, reallocate, release), true);

using Wide = __int128;
using Integer = mpz_class;

/// Integers up to here are doubles, and so are their neighbours.
constexpr std::int64_t largest_small = std::int64_t{1} << 53;

bool is_small(Wide integer) { return integer <= largest_small && -integer <= largest_small; }

Wide greatest_divisor(Wide a, Wide b) {
  while (!is_small(a) || !is_small(b)) {
    if (b == 0) return a < 0 ? -a : a;
    const Wide rest = a % b;
    a = b;
    b = rest;
  }
  return std::gcd(static_cast<std::int64_t>(a), static_cast<std::int64_t>(b));
}

/// sqrt(n) of 0 <= n <= 2^53, if it is whole: these roots of doubles are correctly rounded.
std::optional<std::int64_t> whole_root(std::int64_t n) {
  const auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(n)));
  return root * root == n ? std::optional(root) : std::nullopt;
}

static_assert(sizeof(long) == sizeof(std::int64_t), "GMP takes long");

Integer integer_of(Wide value) {
  const bool negative = value < 0;
  const auto magnitude = static_cast<unsigned __int128>(negative ? -value : value);
  Integer result(static_cast<unsigned long>(magnitude >> 64U));
  result <<= 64;
  result += Integer(static_cast<unsigned long>(magnitude));
  return negative ? Integer(-result) : result;
}

/// The nearest double and what it leaves out, as rounded() of GMP's. Doubles hold p and q here, and what the
/// quotient's rounding leaves of p is a double as well.
Real rounded_fraction(const Fraction& x) {
  const auto p = static_cast<double>(x.numerator), q = static_cast<double>(x.denominator);
  const auto left_over = [q](double dividend, double quotient) {
    const DoubleDouble product = two_product(quotient, q);
    return (dividend - product.high) - product.low;
  };
  const double value = p / q, rest = left_over(p, value);
  const double low = rest / q, last = left_over(rest, low);
  return {value, low, last == 0 ? 0 : std::nextafter(std::abs(last / q), infinity)};
}

/// How often the prime divides n, which loses these factors.
int take_out(Integer& n, unsigned long prime) {
  const Integer factor(prime);
  return static_cast<int>(mpz_remove(n.get_mpz_t(), n.get_mpz_t(), factor.get_mpz_t()));
}

Integer ten_to(int exponent) {
  Integer result;
  mpz_ui_pow_ui(result.get_mpz_t(), 10, static_cast<unsigned long>(exponent));
  return result;
}

}  // namespace

/// Between the two kinds of number.
struct Arithmetic {
  /// In lowest terms, q != 0.
  static Number small_or_large(Wide p, Wide q) {
    if (q == 1 && is_small(p)) {
      Number result;
      result.small_.numerator = static_cast<std::int64_t>(p);
      return result;
    }
    if (q < 0) {
      p = -p;
      q = -q;
    }
    const Wide divisor = greatest_divisor(p, q);
    if (divisor != 1) {
      p /= divisor;
      q /= divisor;
    }
    if (!is_small(p) || !is_small(q)) return large(mpq_class(integer_of(p), integer_of(q)));
    Number result;
    result.small_ = {static_cast<std::int64_t>(p), static_cast<std::int64_t>(q)};
    return result;
  }

  /// `value` is in lowest terms.
  static Number of(mpq_class value) {
    constexpr std::size_t bits = 54;
    const Integer& p = value.get_num();
    const Integer& q = value.get_den();
    const bool fits =
        bits_of(p) <= bits && bits_of(q) <= bits && is_small(p.get_si()) && is_small(q.get_si());
    if (!fits) return large(std::move(value));
    Number result;
    result.small_ = {p.get_si(), q.get_si()};
    return result;
  }

  static Number large(mpq_class value) {
    const std::size_t bits = std::max(bits_of(value.get_num()), bits_of(value.get_den()));
    if (bits > Number::most_bits) throw Error(ErrorCode::too_large, "a number has too many digits");
    const std::size_t words = bits / 64;
    spend_work(1 + words * words / 64);
    Number result;
    result.large_ = std::make_shared<const Number::Large>(Number::Large{std::move(value)});
    return result;
  }

  static mpq_class rational_of(const Number& x) {
    if (x.large_ != nullptr) return x.large_->value;
    return {Integer(static_cast<long>(x.small_.numerator)), Integer(static_cast<long>(x.small_.denominator))};
  }
};

Number::Number(std::int64_t integer) {
  if (is_small(integer)) {
    small_.numerator = integer;
  } else {
    *this = Arithmetic::small_or_large(integer, 1);
  }
}

Number Number::ratio(std::int64_t p, std::int64_t q) { return Arithmetic::small_or_large(p, q); }

Number Number::real(double value) { return Arithmetic::of(rational(value)); }

std::optional<Number> Number::written(std::string_view text) {
  const std::optional<Decimal> decimal = take_apart(text);
  if (!decimal) return std::nullopt;
  if (decimal->digits.empty()) return Number(0);
  constexpr int widest = 400;  // beyond it no double is, however many digits it has
  const int leading = static_cast<int>(decimal->digits.size()) + decimal->exponent;
  if (std::abs(leading) > widest) return std::nullopt;
  constexpr std::size_t most_digits = most_bits / 4;
  if (decimal->digits.size() > most_digits) {
    throw Error(ErrorCode::too_large, "a number has too many digits");
  }
  mpq_class value{Integer(decimal->digits, 10)};
  if (decimal->exponent > 0) value *= ten_to(decimal->exponent);
  if (decimal->exponent < 0) value /= ten_to(-decimal->exponent);
  const double nearest_double = nearest(value);
  if (nearest_double == 0 || std::isinf(nearest_double)) return std::nullopt;
  return Arithmetic::of(std::move(value));
}

bool Number::is_integer() const {
  return large_ != nullptr ? large_->value.get_den() == 1 : small_.denominator == 1;
}

int Number::sign() const {
  if (large_ != nullptr) return sgn(large_->value);
  return (small_.numerator > 0) - (small_.numerator < 0);
}

std::optional<std::int64_t> Number::whole(std::int64_t most) const {
  const bool fits = large_ == nullptr && small_.denominator == 1 && std::abs(small_.numerator) <= most;
  return fits ? std::optional(small_.numerator) : std::nullopt;
}

std::optional<Fraction> Number::small() const {
  return large_ == nullptr ? std::optional(small_) : std::nullopt;
}

Number Number::numerator() const {
  return large_ == nullptr ? Number(small_.numerator) : Arithmetic::of(large_->value.get_num());
}

Number Number::denominator() const {
  return large_ == nullptr ? Number(small_.denominator) : Arithmetic::of(large_->value.get_den());
}

std::optional<Decimal> Number::decimal() const {
  if (is_zero()) return Decimal{};
  const mpq_class value = Arithmetic::rational_of(*this);
  Integer rest = value.get_den();
  const int twos = take_out(rest, 2);
  const int fives = take_out(rest, 5);
  if (rest != 1) return std::nullopt;
  const int decimals = std::max(twos, fives);
  const Integer digits = abs(value.get_num()) * (ten_to(decimals) / value.get_den());
  Decimal result{digits.get_str(), -decimals};
  const std::size_t last = result.digits.find_last_not_of('0');
  result.exponent += static_cast<int>(result.digits.size() - last - 1);
  result.digits.resize(last + 1);
  return result;
}

std::size_t Number::bits() const {
  if (large_ != nullptr) return std::max(bits_of(large_->value.get_num()), bits_of(large_->value.get_den()));
  const auto p = static_cast<std::uint64_t>(std::abs(small_.numerator));
  return static_cast<std::size_t>(std::bit_width(p | static_cast<std::uint64_t>(small_.denominator)));
}

std::size_t Number::hash() const {
  if (large_ == nullptr) {
    return static_cast<std::size_t>(small_.numerator) * 31 + static_cast<std::size_t>(small_.denominator);
  }
  return static_cast<std::size_t>(large_->value.get_num().get_ui()) * 31 +
         static_cast<std::size_t>(large_->value.get_den().get_ui());
}

double Number::value() const {
  if (large_ != nullptr) return nearest(large_->value);
  return static_cast<double>(small_.numerator) / static_cast<double>(small_.denominator);
}

Real Number::rounded() const {
  if (large_ == nullptr && small_.denominator == 1) return static_cast<double>(small_.numerator);
  return large_ == nullptr ? rounded_fraction(small_) : qdot::rounded(large_->value);
}

Number operator+(const Number& a, const Number& b) {
  if (a.large_ == nullptr && b.large_ == nullptr) {
    const Fraction x = a.small_, y = b.small_;
    return Arithmetic::small_or_large(Wide{x.numerator} * y.denominator + Wide{y.numerator} * x.denominator,
                                      Wide{x.denominator} * y.denominator);
  }
  return Arithmetic::of(Arithmetic::rational_of(a) + Arithmetic::rational_of(b));
}

Number operator-(const Number& a) {
  if (a.large_ != nullptr) return Arithmetic::large(-a.large_->value);
  Number result = a;
  result.small_.numerator = -a.small_.numerator;
  return result;
}

Number operator*(const Number& a, const Number& b) {
  if (a.large_ == nullptr && b.large_ == nullptr) {
    return Arithmetic::small_or_large(Wide{a.small_.numerator} * b.small_.numerator,
                                      Wide{a.small_.denominator} * b.small_.denominator);
  }
  return Arithmetic::of(Arithmetic::rational_of(a) * Arithmetic::rational_of(b));
}

Number operator/(const Number& a, const Number& b) {
  if (a.large_ == nullptr && b.large_ == nullptr) {
    return Arithmetic::small_or_large(Wide{a.small_.numerator} * b.small_.denominator,
                                      Wide{a.small_.denominator} * b.small_.numerator);
  }
  return Arithmetic::of(Arithmetic::rational_of(a) / Arithmetic::rational_of(b));
}

bool operator==(const Number& a, const Number& b) {
  if (a.large_ == nullptr || b.large_ == nullptr) return a.large_ == b.large_ && a.small_ == b.small_;
  return a.large_->value == b.large_->value;
}

bool operator<(const Number& a, const Number& b) {
  if (a.large_ == nullptr && b.large_ == nullptr) {
    return Wide{a.small_.numerator} * b.small_.denominator < Wide{b.small_.numerator} * a.small_.denominator;
  }
  return Arithmetic::rational_of(a) < Arithmetic::rational_of(b);
}

Number power(const Number& base, int exponent) {
  Number result(1);
  Number factor = exponent < 0 ? Number(1) / base : base;
  for (int left = std::abs(exponent); left > 0; left /= 2) {
    if (left % 2 == 1) result = result * factor;
    if (left > 1) factor = factor * factor;
  }
  return result;
}

Number gcd(const Number& a, const Number& b) {
  if (a.large_ == nullptr && b.large_ == nullptr) {
    const auto [p, q] = a.small_;
    const auto [r, s] = b.small_;
    return Arithmetic::small_or_large(std::gcd(p, r), Wide{q} / std::gcd(q, s) * s);
  }
  const mpq_class x = Arithmetic::rational_of(a);
  const mpq_class y = Arithmetic::rational_of(b);
  // Of numbers in lowest terms these are in lowest terms again.
  return Arithmetic::of(mpq_class(gcd(x.get_num(), y.get_num()), Integer(lcm(x.get_den(), y.get_den()))));
}

std::optional<Number> exact_root(const Number& square) {
  if (square.is_negative()) return std::nullopt;
  if (square.large_ == nullptr) {
    const auto p = whole_root(square.small_.numerator), q = whole_root(square.small_.denominator);
    return p && q ? std::optional(Number::ratio(*p, *q)) : std::nullopt;
  }
  const mpq_class x = Arithmetic::rational_of(square);
  const bool exact = mpz_perfect_square_p(x.get_num().get_mpz_t()) != 0 &&
                     mpz_perfect_square_p(x.get_den().get_mpz_t()) != 0;
  if (!exact) return std::nullopt;
  return Arithmetic::of(mpq_class(Integer(sqrt(x.get_num())), Integer(sqrt(x.get_den()))));
}

}  // namespace qdot
