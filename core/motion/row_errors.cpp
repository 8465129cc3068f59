#include "core/motion/row_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

constexpr double storing = 0x1p-52;  ///< a number is rounded when it is stored
constexpr double too_much = 0.5;     ///< of a column
constexpr double of_lost = 4;        ///< times the range: the true motion may go farther than those computed

}  // namespace

RowErrors::RowErrors(std::vector<double> scale)
    : scale_(std::move(scale)),
      error_(scale_.size()),
      lowest_(scale_.size(), std::numeric_limits<double>::infinity()),
      highest_(scale_.size(), -std::numeric_limits<double>::infinity()) {}

void RowErrors::add(std::span<const double> row, std::span<const std::span<const double>> others,
                    std::span<const double> unseen) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    double difference = 0;
    for (const auto& other : others) difference = std::max(difference, std::abs(row[k] - other[k]));
    const double missed = unseen.empty() ? 0 : unseen[k];
    error_[k] = std::max(error_[k], safety_of_differences * difference + storing * std::abs(row[k]) + missed);
    lost_ = lost_ || safety_of_differences * difference > too_much * scale_[k];
  }
  widen(row);
  for (const auto& other : others) widen(other);
  if (!lost_) return;
  for (std::size_t k = 0; k < row.size(); ++k)
    error_[k] = std::max(error_[k], of_lost * (highest_[k] - lowest_[k]));
}

void RowErrors::widen(std::span<const double> row) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    lowest_[k] = std::min(lowest_[k], row[k]);
    highest_[k] = std::max(highest_[k], row[k]);
  }
}

}  // namespace qdot
