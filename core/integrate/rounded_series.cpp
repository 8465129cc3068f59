#include "core/integrate/rounded_series.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/numerics/random_bits.hpp"

namespace qdot {
namespace {

constexpr double last_bit = 0x1p-53, most_enlarged = 0x1p27;
constexpr double least_enlarged = 16;
constexpr double small_off = 0.005;  ///< as ExtendedStepper holds the terms of the motion itself
constexpr double shorter = 0.8;
constexpr int most_shorter = 200;
constexpr double several = 16;  ///< times what low coefficients show: it may be little by chance

/// From a half to three halves, on some side.
double aside(RandomBits& random) { return (random() % 2 == 0 ? 1 : -1) * (0.5 + random.fraction()); }

}  // namespace

RoundedSeries::RoundedSeries(const RightHandSide& in_doubles, unsigned first_in_doubles)
    : in_doubles_(in_doubles), first_in_doubles_(first_in_doubles), order_(first_in_doubles + 1) {}

void RoundedSeries::take(double t, std::span<const DoubleDouble> c, unsigned order,
                         std::span<const double> of_forces, double h) {
  const std::size_t width = 2 * of_forces.size(), n = of_forces.size();
  RandomBits random(std::bit_cast<std::uint64_t>(t));
  y_.resize(width);
  c_.resize(width * (order_ + 1));
  r_.assign(width * order_, 0.0);
  enlarge(c, order, of_forces, h);
  for (std::size_t i = 0; i < width; ++i) {
    const double y = c[i * (order + 1)].high, pushed = i < n ? 0 : h * of_forces[i - n];
    y_[i] = y + enlarged_ * aside(random) * (last_bit * std::abs(y) + pushed);
  }
  if (order < order_ || in_doubles_.expansion(t, y_, order_, c_) != Evaluation::ok) return;
  own_.assign(width * (order_ + 1), 0.0);
  for (std::size_t i = 0; i < width; ++i) y_[i] = c[i * (order + 1)].high;
  if (in_doubles_.expansion(t, y_, order_, own_) != Evaluation::ok) return;
  for (std::size_t i = 0; i < width; ++i) {
    for (unsigned k = 1; k <= order_; ++k) {
      const double moved = std::abs(c_[i * (order_ + 1) + k] - c[i * (order + 1) + k].high);
      r_[i * order_ + k - 1] = std::isfinite(moved) ? moved / enlarged_ : 0;
    }
  }
  take_share(c, order, told_part(h));
}

void RoundedSeries::enlarge(std::span<const DoubleDouble> c, unsigned order,
                            std::span<const double> of_forces, double h) {
  const std::size_t n = of_forces.size();
  const auto size = [&](std::size_t i) { return std::abs(c[i * (order + 1)].high); };
  enlarged_ = most_enlarged;
  for (std::size_t i = 0; i < n; ++i) {
    const double pushed = h * of_forces[i], room = std::max(size(n + i), size(i) / h);
    if (pushed * enlarged_ > room) enlarged_ = room / pushed;
  }
  is_pushed_ = enlarged_ < least_enlarged;
  enlarged_ = std::max(enlarged_, least_enlarged);
}

/// By the coefficients that are known in both.
void RoundedSeries::take_share(std::span<const DoubleDouble> c, unsigned order, double h) {
  double seen = 0, sampled = 0;
  for (std::size_t i = 0; i < y_.size(); ++i) {
    double power = h;
    for (unsigned k = 2; k < first_in_doubles_; ++k) {
      power *= h;
      const double rounded = (c[i * (order + 1) + k] - DoubleDouble(own_[i * (order_ + 1) + k])).value();
      seen = std::max(seen, power * std::abs(rounded));
      sampled = std::max(sampled, power * r_[i * order_ + k - 1]);
    }
  }
  share_ = sampled > 0 ? std::min(1.0, several * seen / sampled) : 1;
}

double RoundedSeries::told_part(double h) const {
  const auto is_told = [&] {
    for (std::size_t i = 0; i < y_.size() / 2; ++i) {
      const double in_doubles = largest(i, first_in_doubles_, order_ + 1, h);
      if (in_doubles > small_off * largest(i, 1, first_in_doubles_, h)) return false;
    }
    return true;
  };
  for (int i = 0; i < most_shorter && !is_told(); ++i) h *= shorter;
  return h;
}

double RoundedSeries::off(std::size_t i, double h) const {
  return share_ * largest(i, first_in_doubles_, order_ + 1, h);
}

/// r_k h^k, from <= k < to.
double RoundedSeries::largest(std::size_t i, unsigned from, unsigned to, double h) const {
  double power = 1, largest = 0;
  for (unsigned k = 1; k < to; ++k) {
    power *= h;
    if (k >= from) largest = std::max(largest, power * r_[i * order_ + k - 1]);
  }
  return largest;
}

}  // namespace qdot
