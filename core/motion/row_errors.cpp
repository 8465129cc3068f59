#include "core/motion/row_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

constexpr double storing = 0x1p-52;      ///< a number is rounded when it is stored
constexpr double too_much = 0.5;         ///< of a column
constexpr double safety_of_samples = 2;  ///< of what another is off by: one sample of its signs
constexpr double of_lost = 4;  ///< times the range: the true motion may go farther than those computed

double largest_difference(std::size_t k, std::span<const double> row, std::span<const OtherRow> others) {
  double difference = 0;
  for (const OtherRow& other : others) difference = std::max(difference, std::abs(row[k] - other.row[k]));
  return difference;
}

}  // namespace

double error_of_row(std::size_t k, std::span<const double> row, std::span<const OtherRow> others,
                    std::span<const double> unseen) {
  const double difference = largest_difference(k, row, others);
  double apart = 0;
  for (const OtherRow& other : others) {
    if (!other.apart.empty()) apart = std::max(apart, other.apart[k]);
  }
  return difference + std::max(difference, safety_of_samples * apart) + storing * std::abs(row[k]) +
         (unseen.empty() ? 0 : unseen[k]);
}

RowErrors::RowErrors(std::vector<double> scale, Winding winding)
    : scale_(std::move(scale)),
      error_(scale_.size()),
      winding_(std::move(winding)),
      lowest_(scale_.size(), std::numeric_limits<double>::infinity()),
      highest_(scale_.size(), -std::numeric_limits<double>::infinity()) {}

void RowErrors::add(double t, std::span<const double> row, std::span<const OtherRow> others,
                    std::span<const double> unseen) {
  const bool is_first = error_before_.empty();
  if (!lost_) error_before_ = error_;
  for (std::size_t k = 0; k < row.size(); ++k) {
    error_[k] = std::max(error_[k], error_of_row(k, row, others, unseen));
    lost_ = lost_ || safety_of_differences * largest_difference(k, row, others) > too_much * scale_[k];
  }
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
  for (std::size_t k = 0; k < row.size(); ++k) {
    lowest_[k] = std::min(lowest_[k], row[k]);
    highest_[k] = std::max(highest_[k], row[k]);
  }
}

}  // namespace qdot
