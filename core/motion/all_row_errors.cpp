#include "core/motion/all_row_errors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/numerics/pairs.hpp"

namespace qdot {
namespace {

constexpr double part = 0.1;  ///< of its own time, in which no difference changes its sign twice

bool is_whole(double x) {
  constexpr double without_fractions = 0x1p53;
  return !(std::abs(x) < without_fractions) || x == static_cast<double>(static_cast<std::int64_t>(x));
}

/// Of a number that is not negative.
double next_above(double x) { return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + 1); }

void take_larger(std::span<const double> table, std::vector<double>& most) {
  const std::size_t count = std::min(table.size(), most.size());
  for (std::size_t i = 0; i < count; i += 2)
    put_pair(&most[i], larger_or(pair_at(&table[i]), pair_at(&most[i])));
}

void take_larger_differences(std::span<const double> one, std::span<const double> other,
                             std::vector<double>& most) {
  const std::size_t count = std::min(other.size(), most.size());
  for (std::size_t i = 0; i < count; i += 2) {
    const PairOfDoubles difference = magnitudes(pair_at(&one[i]) - pair_at(&other[i]));
    put_pair(&most[i], larger_or(difference, pair_at(&most[i])));
  }
}

}  // namespace

AllRowErrors::AllRowErrors(const RowsToCompare& motion, std::vector<OtherRows> others,
                           AccelerationsAt accelerations, RowErrors::Winding winding)
    : motion_(motion),
      others_(std::move(others)),
      accelerations_at_(std::move(accelerations)),
      winding_(std::move(winding)),
      width_(motion.sizes.size()),
      accelerations_(width_ / 2) {}

std::vector<double> AllRowErrors::first(std::size_t rows, double lost_from) {
  rows_ = rows;
  take_others();
  add_roundings_of_instants();
  add_slopes_of_differences();
  return is_lost(lost_from) ? with_lost(lost_from) : while_known();
}

void AllRowErrors::take_others() {
  for (std::vector<double>* table : {&difference_, &apart_, &missed_}) table->assign(rows_ * width_, 0.0);
  for (const OtherRows& other : others_) {
    const std::size_t count = other.rows * width_;
    const auto rows = [count](std::span<const double> of) { return of.first(std::min(of.size(), count)); };
    take_larger_differences(motion_.states, rows(other.states), difference_);
    take_larger(rows(other.apart), apart_);
    take_larger(rows(other.unseen), missed_);
  }
}

void AllRowErrors::add_roundings_of_instants() {
  const std::size_t n = width_ / 2;
  double* missed = missed_.data();
  const double* y = motion_.states.data();
  for (std::size_t row = 0; row < rows_; ++row, missed += width_, y += width_) {
    const double rounded = rounding_of_instant(row);
    if (rounded == 0) continue;
    const double* const a = accelerations_at(row);
    for (std::size_t i = 0; a != nullptr && i < n; ++i) {
      missed[i] += rounded * std::abs(y[n + i]);
      missed[n + i] += rounded * std::abs(a[i]);
    }
  }
}

double AllRowErrors::rounding_of_instant(std::size_t row) const {
  const double t = motion_.t[row];
  const bool is_short = is_whole(t * 0x1p20);  // and so a decimal, too
  return is_short ? std::abs(motion_.left_out[row]) : (next_above(std::abs(t)) - std::abs(t)) / 2;
}

/// Bounds of them near the row that a check has, or their values there; nullptr where there are none.
const double* AllRowErrors::accelerations_at(std::size_t row) {
  const std::size_t n = width_ / 2;
  for (const OtherRows& other : others_) {
    if (row >= other.rows || other.accelerations.empty()) continue;
    const double* const bounds = other.accelerations.data() + row * n;
    if (std::none_of(bounds, bounds + n, [](double a) { return std::isnan(a); })) return bounds;
  }
  return accelerations_at_(row, accelerations_) ? accelerations_.data() : nullptr;
}

void AllRowErrors::add_slopes_of_differences() {
  const std::size_t n = width_ / 2;
  const std::span<const double> t = motion_.t;
  for (std::size_t i = 0; i < n; ++i) {
    const double tau = motion_.sizes[i] / motion_.sizes[n + i];
    if (!(tau > 0 && std::isfinite(tau))) continue;
    const double* difference = difference_.data() + i;
    double* missed = missed_.data() + i;
    for (std::size_t row = 0; row < rows_; ++row, difference += width_, missed += width_) {
      const double to_next = row + 1 < t.size() ? t[row + 1] - t[row] : row > 0 ? t[row] - t[row - 1] : 0;
      const double away = std::min(to_next / 2, part * tau);
      missed[0] += away * difference[n];
      missed[n] += away / tau * (difference[0] / tau);
    }
  }
}

bool AllRowErrors::is_lost(double lost_from) const {
  if (rows_ > 0 && motion_.t[rows_ - 1] >= lost_from) return true;
  for (std::size_t k = 0; k < width_; k += 2) {
    const PairOfDoubles size = pair_at(&motion_.sizes[k]);
    auto is_lost = size > size;
    for (std::size_t i = k; i < difference_.size(); i += width_)
      is_lost |= is_too_much(pair_at(&difference_[i]), size);
    if (is_lost[0] != 0 || is_lost[1] != 0) return true;
  }
  return false;
}

/// Errors grow.
std::vector<double> AllRowErrors::while_known() const {
  std::vector<double> errors(rows_ * width_);
  for (std::size_t k = 0; k < width_; k += 2) {
    PairOfDoubles so_far{};
    for (std::size_t i = k; i < errors.size(); i += width_) {
      const LargestOff most{pair_at(&difference_[i]), pair_at(&apart_[i])};
      so_far = larger_or(most.error(pair_at(&motion_.states[i]), pair_at(&missed_[i])), so_far);
      put_pair(&errors[i], so_far);
    }
  }
  return errors;
}

std::vector<double> AllRowErrors::with_lost(double lost_from) const {
  RowErrors all({motion_.sizes.begin(), motion_.sizes.end()}, winding_);
  std::vector<double> errors;
  errors.reserve(rows_ * width_);
  std::vector<OtherRow> same_row;
  for (std::size_t row = 0; row < rows_; ++row) {
    const auto of_row = [&](std::span<const double> table) { return table.subspan(row * width_, width_); };
    same_row.clear();
    for (const OtherRows& other : others_) {
      if (row >= other.rows) continue;
      same_row.push_back({of_row(other.states), other.apart.empty() ? other.apart : of_row(other.apart)});
    }
    if (motion_.t[row] >= lost_from) all.lose();
    all.add(motion_.t[row], of_row(motion_.states), same_row, of_row(missed_));
    errors.insert(errors.end(), all.so_far().begin(), all.so_far().end());
  }
  return errors;
}

}  // namespace qdot
