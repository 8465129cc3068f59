#include "core/expr/monomial.hpp"

#include <cstdlib>
#include <numeric>

#include "core/base/error.hpp"

namespace qdot {
namespace {

constexpr std::int64_t largest_sum_of_exponents = 1'000'000;

Atom sum_of_exponents(const Atom& a, const Atom& b) {
  const std::int64_t p = std::int64_t{a.p} * b.q + std::int64_t{b.p} * a.q;
  const std::int64_t q = std::int64_t{a.q} * b.q;
  const std::int64_t divisor = std::gcd(p, q);
  if (std::abs(p / divisor) > largest_sum_of_exponents || q / divisor > largest_sum_of_exponents) {
    throw Error(ErrorCode::too_large, "an exponent grows too large");
  }
  return {a.base, static_cast<int>(p / divisor), static_cast<int>(q / divisor)};
}

}  // namespace

bool has_less_exponent(const Atom& a, const Atom& b) {
  return std::int64_t{a.p} * b.q < std::int64_t{b.p} * a.q;
}

bool LeadingFirst::operator()(const Monomial& a, const Monomial& b) const {
  auto x = a.begin();
  auto y = b.begin();
  while (x != a.end() && y != b.end()) {
    if (x->base < y->base) return x->p > 0;
    if (y->base < x->base) return y->p < 0;
    if (x->p != y->p || x->q != y->q) return has_less_exponent(*y, *x);
    ++x;
    ++y;
  }
  if (x != a.end()) return x->p > 0;
  return y != b.end() && y->p < 0;
}

Monomial operator*(const Monomial& a, const Monomial& b) {
  Monomial product;
  product.reserve(a.size() + b.size());
  auto x = a.begin();
  auto y = b.begin();
  while (x != a.end() || y != b.end()) {
    if (y == b.end() || (x != a.end() && x->base < y->base)) {
      product.push_back(*x++);
    } else if (x == a.end() || y->base < x->base) {
      product.push_back(*y++);
    } else {
      const Atom joined = sum_of_exponents(*x++, *y++);
      if (joined.p != 0) product.push_back(joined);
    }
  }
  return product;
}

Monomial inverse(const Monomial& a) {
  Monomial result = a;
  for (Atom& atom : result) atom.p = -atom.p;
  return result;
}

Monomial times(const Monomial& a, NodeId base, int p, int q) {
  return p == 0 ? a : a * Monomial{{base, p, q}};
}

int exponent_of(const Monomial& a, NodeId base) {
  for (const Atom& atom : a) {
    if (atom.base == base) return atom.q == 1 ? atom.p : 0;
  }
  return 0;
}

}  // namespace qdot
