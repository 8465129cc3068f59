#include "core/expr/rational.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

using Integer = mpz_class;

/// n 2^shift, shift of either sign; rounded down.
Integer shifted(const Integer& n, long shift) {
  return shift >= 0 ? Integer(n << static_cast<mp_bitcnt_t>(shift))
                    : Integer(n >> static_cast<mp_bitcnt_t>(-shift));
}

/// The double nearest to p/q, p >= 0 and q > 0; halfway between two, the even one.
double nearest_quotient(const Integer& p, const Integer& q) {
  constexpr int digits = 53;
  constexpr long least_exponent = -1074;
  if (p == 0) return 0;
  // p/q = (n + a fraction) 2^-shift, n of three or four bits more than a double has.
  const long shift = digits + 3 - (static_cast<long>(bits_of(p)) - static_cast<long>(bits_of(q)));
  const Integer dividend = shift > 0 ? shifted(p, shift) : p;
  const Integer divisor = shift < 0 ? shifted(q, -shift) : q;
  const Integer quotient = dividend / divisor;
  const bool exact = quotient * divisor == dividend;
  const std::uint64_t n = 2 * static_cast<std::uint64_t>(quotient.get_ui()) + (exact ? 0 : 1);
  long dropped = std::bit_width(n) - digits;
  dropped = std::max(dropped, least_exponent + shift + 1);
  if (dropped > 62) return 0;
  const std::uint64_t unit = std::uint64_t{1} << static_cast<unsigned>(dropped);
  const std::uint64_t rest = n % unit;
  std::uint64_t kept = n / unit;
  if (rest > unit / 2 || (rest == unit / 2 && kept % 2 == 1)) ++kept;
  return std::ldexp(static_cast<double>(kept), static_cast<int>(dropped - shift - 1));
}

/// Not below |x|.
double bound_of(const mpq_class& x) {
  if (x == 0) return 0;
  return std::max(std::nextafter(std::abs(nearest(x)), infinity), std::numeric_limits<double>::denorm_min());
}

}  // namespace

std::size_t bits_of(const mpz_class& n) { return mpz_sizeinbase(n.get_mpz_t(), 2); }

mpq_class rational(double value) {
  mpq_class result;
  mpq_set_d(result.get_mpq_t(), value);
  return result;
}

double nearest(const mpq_class& x) {
  const double size = nearest_quotient(abs(x.get_num()), x.get_den());
  return x < 0 ? -size : size;
}

Real rounded(const mpq_class& x) {
  Real result(nearest(x));
  if (!std::isfinite(result.value)) return result;
  const mpq_class rest = x - rational(result.value);
  result.low = nearest(rest);
  result.error = bound_of(rest - rational(result.low));
  return result;
}

}  // namespace qdot
