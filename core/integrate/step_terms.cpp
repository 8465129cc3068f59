#include "core/integrate/step_terms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace qdot {
namespace {

using PairOfTerms [[gnu::vector_size(16)]] = double;

PairOfTerms terms_at(const double* x) {
  PairOfTerms v;
  std::memcpy(&v, x, sizeof v);
  return v;
}

PairOfTerms sizes_of(PairOfTerms x) {
  using Bits [[gnu::vector_size(16)]] = std::uint64_t;
  constexpr std::uint64_t without_sign = ~(std::uint64_t{1} << 63);
  Bits bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits &= Bits{without_sign, without_sign};
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

PairOfTerms larger_of(PairOfTerms x, PairOfTerms y) { return x > y ? x : y; }

/// The largest |c_k| h^k, 0 <= k <= order.
double largest_term(const double* c, const double* powers, unsigned order) {
  PairOfTerms most{};
  unsigned k = 0;
  for (; k < order; k += 2) most = larger_of(sizes_of(terms_at(c + k)) * terms_at(powers + k), most);
  const double largest = std::max(most[0], most[1]);
  return k == order ? std::max(largest, std::abs(c[k]) * powers[k]) : largest;
}

}  // namespace

void StepTerms::take(const MotionPiece& step) {
  powers_.resize(step.order + 1);
  double power = 1;
  for (double& x : powers_) {
    x = power;
    power *= step.h;
  }
  const double* c = step.rows.data();
  for (double& largest : largest_) {
    largest = largest_term(c, powers_.data(), step.order);
    c += step.order + 1;
  }
}

StepTerms::Difference StepTerms::subtract(const double* own, unsigned order, double least, double* c) const {
  PairOfTerms most{};
  const double* powers = powers_.data();
  double sum = 0, largest = least;
  unsigned k = 1;
  for (; k < order; k += 2) {
    const PairOfTerms term = (terms_at(own + k) - terms_at(c + k)) * terms_at(powers + k);
    std::memcpy(c + k, &term, sizeof term);
    most = larger_of(sizes_of(term), most);
    sum += term[0];
    sum += term[1];
  }
  if (k == order) {
    c[k] = (own[k] - c[k]) * powers[k];
    sum += c[k];
    largest = std::max(largest, std::abs(c[k]));
  }
  return {sum, std::max({largest, most[0], most[1]})};
}

}  // namespace qdot
