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

double error_of(std::size_t k, double difference, std::span<const double> row,
                std::span<const OtherRow> others, std::span<const double> unseen) {
  double apart = 0;
  for (const OtherRow& other : others) {
    if (!other.apart.empty()) apart = std::max(apart, other.apart[k]);
  }
  return difference + std::max(difference, safety_of_samples * apart) + storing * std::abs(row[k]) +
         (unseen.empty() ? 0 : unseen[k]);
}

}  // namespace

double error_of_row(std::size_t k, std::span<const double> row, std::span<const OtherRow> others,
                    std::span<const double> unseen) {
  return error_of(k, largest_difference(k, row, others), row, others, unseen);
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
  double* const error = error_.data();
  const double* const scale = scale_.data();
  bool is_lost = lost_;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const double difference = largest_difference(k, row, others);
    error[k] = std::max(error[k], error_of(k, difference, row, others, unseen));
    is_lost = is_lost | (safety_of_differences * difference > too_much * scale[k]);
  }
  lost_ = is_lost;
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
  for (std::size_t k = 0; k < row.size(); ++k) {
    lowest[k] = std::min(lowest[k], row[k]);
    highest[k] = std::max(highest[k], row[k]);
  }
}

}  // namespace qdot
