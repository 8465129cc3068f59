#include "core/motion/row_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace qdot {
namespace {

constexpr double storing = 0x1p-52;      ///< a number is rounded when it is stored
constexpr double too_much = 0.5;         ///< of a column
constexpr double safety_of_samples = 2;  ///< of what another is off by: one sample of its signs
constexpr double of_lost = 4;  ///< times the range: the true motion may go farther than those computed

/// In one column of a row.
struct Largest {
  double difference{}, apart{};  ///< of the others from it, and from what they stand for

  [[nodiscard]] double error(double value, double unseen) const {
    return difference + std::max(difference, safety_of_samples * apart) + storing * std::abs(value) + unseen;
  }
};

inline Largest largest_of(std::size_t k, double value, std::span<const OtherRow> others) {
  Largest largest;
  for (const OtherRow& other : others) {
    largest.difference = std::max(largest.difference, std::abs(value - other.row[k]));
    if (!other.apart.empty()) largest.apart = std::max(largest.apart, other.apart[k]);
  }
  return largest;
}

}  // namespace

double error_of_row(std::size_t k, std::span<const double> row, std::span<const OtherRow> others,
                    std::span<const double> unseen) {
  return largest_of(k, row[k], others).error(row[k], unseen.empty() ? 0 : unseen[k]);
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
  bool is_lost = lost_ || lost_from_next_;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const Largest largest = largest_of(k, row[k], others);
    error[k] = std::max(before[k], largest.error(row[k], unseen.empty() ? 0 : unseen[k]));
    is_lost = is_lost | (safety_of_differences * largest.difference > too_much * scale[k]);
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
