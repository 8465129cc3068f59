#include "core/motion/row_errors.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace qdot {
namespace {

constexpr double of_lost = 4;  ///< times the range: the true motion may go farther than those computed

inline LargestOff largest_of(std::size_t k, PairOfDoubles value, std::span<const OtherRow> others) {
  LargestOff largest;
  for (const OtherRow& other : others) {
    largest.difference = larger_or(magnitudes(value - pair_at(&other.row[k])), largest.difference);
    if (!other.apart.empty()) largest.apart = larger_or(pair_at(&other.apart[k]), largest.apart);
  }
  return largest;
}

inline PairOfDoubles pair_or_zeros(std::span<const double> x, std::size_t k) {
  return x.empty() ? PairOfDoubles{} : pair_at(&x[k]);
}

}  // namespace

double error_of_row(std::size_t k, std::span<const double> row, std::span<const OtherRow> others,
                    std::span<const double> unseen) {
  const std::size_t first = k - k % 2;
  const PairOfDoubles value = pair_at(&row[first]);
  return largest_of(first, value, others).error(value, pair_or_zeros(unseen, first))[k % 2];
}

RowErrors::RowErrors(std::vector<double> scale, Winding winding)
    : scale_(std::move(scale)),
      error_(scale_.size()),
      winding_(std::move(winding)),
      error_before_(error_),
      lowest_(scale_.size(), std::numeric_limits<double>::infinity()),
      highest_(scale_.size(), -std::numeric_limits<double>::infinity()) {}

void RowErrors::add(double t, std::span<const double> row, std::span<const OtherRow> others,
                    std::span<const double> unseen) {
  const bool is_first = std::exchange(is_first_, false);
  if (!lost_) error_before_.swap(error_);
  const double* const before = lost_ ? error_.data() : error_before_.data();
  double* const error = error_.data();
  const double* const scale = scale_.data();
  auto is_lost = PairOfDoubles{} > PairOfDoubles{};
  for (std::size_t k = 0; k < row.size(); k += 2) {
    const PairOfDoubles value = pair_at(&row[k]);
    const LargestOff largest = largest_of(k, value, others);
    put_pair(error + k, larger_or(largest.error(value, pair_or_zeros(unseen, k)), pair_at(before + k)));
    is_lost |= is_too_much(largest.difference, pair_at(scale + k));
  }
  lost_ = lost_ || lost_from_next_ || is_lost[0] != 0 || is_lost[1] != 0;
  widen(row);
  for (const OtherRow& other : others) widen(other.row);
  if (!lost_ || is_first) t_before_ = t;
  if (lost_) widen_lost(t);
}

void RowErrors::widen_lost(double t) {
  if (winds_.empty()) winds_ = winding_();
  const std::size_t n = winds_.size();
  for (std::size_t k = 0; k < error_.size(); ++k) {
    error_[k] = std::max(error_[k], of_lost * range(k));
    if (k >= n || !winds_[k]) continue;
    const double apart = safety_of_differences * range(n + k) * (t - t_before_);
    error_[k] = std::max(error_[k], error_before_[k] + apart);
  }
}

void RowErrors::widen(std::span<const double> row) {
  double *const lowest = lowest_.data(), *const highest = highest_.data();
  for (std::size_t k = 0; k < row.size(); k += 2) {
    const PairOfDoubles y = pair_at(&row[k]), least = pair_at(lowest + k);
    put_pair(lowest + k, y < least ? y : least);
    put_pair(highest + k, larger_or(y, pair_at(highest + k)));
  }
}

}  // namespace qdot
