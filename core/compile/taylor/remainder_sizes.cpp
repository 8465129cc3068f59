// How large the coefficients of the rows are over a step, and with them the ranges of rows and the terms that
// products do not keep.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/compile/taylor/remainder.hpp"
#include "core/numerics/pairs.hpp"
#include "core/numerics/rough_powers.hpp"
#include "core/numerics/whole_power.hpp"

namespace qdot::taylor {
namespace {

/// sum over i < count of a_i b_i; count is a multiple of four.
double dot(const double* a, const double* b, unsigned count) {
  PairOfDoubles first{}, second{};
  for (unsigned i = 0; i < count; i += 4) {
    first += pair_at(a + i) * pair_at(b + i);
    second += pair_at(a + i + 2) * pair_at(b + i + 2);
  }
  first += second;
  return first[0] + first[1];
}

/// a u + b u^2 for 0 <= u <= 1, and by so much more or less.
Range parabola(double a, double b, double rest) {
  if (std::isnan(a + b)) return {};
  const double u = -a / (2 * b);
  const bool has_extremum = (u > 0) & (u < 1);  // no branch: nobody could foretell which way it goes
  const double extremum = has_extremum ? 0.5 * a * u : 0;
  const double least = std::min(std::min(0.0, a + b), extremum);
  const double most = std::max(std::max(0.0, a + b), extremum);
  return range(least - rest, most + rest);
}

unsigned padded(unsigned count) { return (count + 3) / 4 * 4; }

/// x^k for k up to order, four side by side: a chain of products would wait for each of them.
/// They are no less than the least number of full precision: where they underflow, terms would be hidden.
template <std::size_t size>
void fill_powers(std::array<double, size>& powers, double x, unsigned order) {
  constexpr double least = std::numeric_limits<double>::min();
  const double x2 = x * x, x4 = x2 * x2;
  PairOfDoubles low{1, x}, high{x2, x2 * x};
  for (unsigned k = 0; k <= order; k += 4, low *= x4, high *= x4) {
    put_pair(&powers[k], low);
    put_pair(&powers[k + 2], high);
  }
  if (powers[order] >= least) return;
  for (unsigned k = 0; k <= order; ++k) powers[k] = std::max(powers[k], least);
}

}  // namespace

void Remainder::begin(double h, unsigned order) {
  h_ = h;
  order_ = order;
  fill_powers(powers_, h, order);
  for (const Index i : state_) rows_[i].own_top = size(rows_[i], order);
}

std::array<double, 2> Remainder::sums_of_sizes(Index first, Index second) const {
  const double *x = rows_[first].coefficients, *y = rows_[second].coefficients;
  PairOfDoubles sum{};
  for (unsigned k = 0; k <= order_; ++k) sum += magnitudes(PairOfDoubles{x[k], y[k]}) * powers_[k];
  return {sum[0], sum[1]};
}

std::array<double, 2> Remainder::sums_of_slopes(Index first, Index second) const {
  const double *x = rows_[first].coefficients, *y = rows_[second].coefficients;
  PairOfDoubles sum{};
  double factor = 1;
  for (unsigned k = 1; k <= order_; ++k, factor += 1)
    sum += factor * (magnitudes(PairOfDoubles{x[k], y[k]}) * powers_[k]);
  return {sum[0], sum[1]};
}

double Remainder::decay() const {
  double first = 0, last = 0;
  for (std::size_t i = n_; i < 2 * n_; ++i) {
    const Row& velocity = rows_[state_[i]];
    first = std::max(first, size(velocity, 1) + size(velocity, 2));
    last = std::max(last, size(velocity, order_ - 1) + size(velocity, order_));
  }
  const double share = last / first;
  if (!(share < 1)) return 1;
  const double rho = rough_exp2(rough_log2(std::max(share, 1e-40)) / (order_ - 2));
  return rho < 1 ? rho : 1;
}

void Remainder::take_norms() {
  const double rho = decay();
  rho_ = rho;
  rho3_ = rho * rho * rho;
  rho_of_rate_ = whole_power(rho, order_ - 1);
  rho_of_value_ = rho_of_rate_ * rho;
  beyond_ = 1 / (1 - rho);
  const double g = h_ / rho;
  fill_powers(radii_, g, order_);
  if (order_ != order_of_degrees_) take_degrees();
  measure_(factors_.data(), static_cast<unsigned>(factors_.size()),
           {h_, powers_[2], beyond_, rho3_, rounding_of_sums, radii_.data()});
  for (RowSizes* const sizes : factors_) {
    Row& row = static_cast<Row&>(*sizes);
    row.of_row = row.of_value = range(row.lower, row.upper);
  }
}

void Remainder::take_degrees() {
  for (RowSizes* const sizes : factors_) {
    const Row& row = static_cast<const Row&>(*sizes);
    sizes->degree = order_ - std::min(order_, row.missing);
  }
  order_of_degrees_ = order_;
}

void Remainder::take_tails(std::span<RowSizes* const> rows) {
  for (RowSizes* const sizes : rows) take_sizes(static_cast<Row&>(*sizes));
  for (std::size_t i = 0; i < rows.size(); i += 4) sum_tails(&rows[i]);
  for (RowSizes* const sizes : rows) {
    Row& row = static_cast<Row&>(*sizes);
    row.t3 = row.reversed_tails[order_ - 3];
    take_range(row);
  }
}

void Remainder::take_sizes(Row& row) {
  const unsigned count = order_ - row.missing + 1, all = padded(order_ + 1);
  for (unsigned k = 0; k < count; ++k) row.a[k] = std::abs(row.coefficients[k]) * powers_[k];
  for (unsigned k = count; k < all; ++k) row.a[k] = 0;
}

/// Of four rows side by side, as each sum alone would wait for itself.
void Remainder::sum_tails(RowSizes* const* four) {
  std::array<Row*, 4> rows{};
  for (std::size_t i = 0; i < 4; ++i) rows[i] = static_cast<Row*>(four[i]);
  std::array<double, 4> sum{};
  for (unsigned k = 0; k <= order_; ++k) {
    for (std::size_t i = 0; i < 4; ++i) rows[i]->reversed_tails[k] = sum[i] += rows[i]->a[order_ - k];
  }
  for (std::size_t i = 0; i < 4; ++i) rows[i]->reversed_tails[order_ + 1] = sum[i];
}

void Remainder::take_range(Row& row) {
  const double* c = row.coefficients;
  row.t2 = row.t3 + size(row, 2);
  row.t0 = row.t2 + size(row, 1) + std::abs(c[0]);
  row.of_row = parabola(c[1] * h_, c[2] * powers_[2], row.t3 + rounding_of_sums * row.t0) + c[0];
  row.of_value = row.of_row;
}

double Remainder::product_norm(const Row& a, const Row& b) {
  return std::min(a.norm * b.peak, a.peak * b.norm);
}

double Remainder::tail(const Row& a, const Row& b) const {
  if (effort_ != Effort::rough) return dot(a.a.data(), b.reversed_tails.data(), padded(order_ + 1));
  return rho_of_value_ * product_norm(a, b) + std::abs(a.coefficients[0]) * b.own_top +
         std::abs(b.coefficients[0]) * a.own_top;
}

double Remainder::tail_of_rate(const Row& rate, const Row& b) const {
  if (effort_ != Effort::rough) return dot(rate.a.data(), b.reversed_tails.data() + 1, padded(order_ + 1));
  return rho_of_rate_ * product_norm(rate, b) +
         std::abs(rate.coefficients[0]) * (size(b, order_ - 1) + b.own_top) +
         std::abs(b.coefficients[0]) * (size(rate, order_ - 1) + size(rate, order_));
}

Range Remainder::variation(const Row& rate) const {
  const double* c = rate.coefficients;
  return parabola(c[0] * h_, 0.5 * c[1] * powers_[2], h_ / 3 * rate.t2);
}

double Remainder::beyond_third(const Row& row) const {
  const double beyond = effort_ == Effort::rough ? rho_ * (row.t2 - size(row, 2)) : row.t3 - size(row, 3);
  return beyond + rounding_of_sums * row.t0 + row.r;
}

double Remainder::beyond_second(const Row& row) const {
  return row.t2 - size(row, 2) + rounding_of_sums * row.t0 + row.r;
}

}  // namespace qdot::taylor
