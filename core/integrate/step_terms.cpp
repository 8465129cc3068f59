#include "core/integrate/step_terms.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

/// The larger of the largest |c_k| h^k, 0 <= k <= order, and the magnitude of their sum.
double largest_term(const double* c, const double* powers, unsigned order) {
  PairOfDoubles most{}, sum{};
  unsigned k = 0;
  for (; k < order; k += 2) {
    const PairOfDoubles terms = pair_at(c + k) * pair_at(powers + k);
    most = larger_or(magnitudes(terms), most);
    sum += terms;
  }
  const double last = k == order ? c[k] * powers[k] : 0;
  const double end = std::abs(sum[0] + sum[1] + last);
  const double largest = std::max({most[0], most[1], std::abs(last)});
  return end > largest ? end : largest;
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

StepTerms::Difference<double> StepTerms::subtract(const double* own, unsigned order, double least,
                                                  double* c) const {
  PairOfDoubles most{};
  const double* powers = powers_.data();
  double sum = 0, largest = least;
  unsigned k = 1;
  for (; k < order; k += 2) {
    const PairOfDoubles term = (pair_at(own + k) - pair_at(c + k)) * pair_at(powers + k);
    put_pair(c + k, term);
    most = larger_or(magnitudes(term), most);
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

StepTerms::Difference<PairOfDoubles> StepTerms::subtract(const double* own, unsigned order,
                                                         PairOfDoubles least, PairOfDoubles* c) const {
  PairOfDoubles sum{}, most{};
  for (unsigned k = 1; k <= order; ++k) {
    const PairOfDoubles term = (own[k] - c[k]) * powers_[k];
    c[k] = term;
    most = larger_or(magnitudes(term), most);
    sum += term;
  }
  return {sum, larger_or(most, least)};
}

}  // namespace qdot
