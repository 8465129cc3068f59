#include "core/motion/unseen_along.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace qdot {
namespace {

constexpr double longer =
    0x1p20;  ///< than an instant's rounding: what the map changes meanwhile is no rounding

/// What the map changes in each component for each second that the impact is taken too late.
std::vector<double> rates_of_map(const SectionEnd& impact, double late) {
  std::vector<double> rates(impact.after.size());
  if (!impact.map || !(late > 0)) return rates;
  const double tau = longer * late;
  const std::vector<double> later = impact.map(impact.t + tau, impact.before);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double rate = (later[i] - impact.after[i]) / tau;
    if (std::isfinite(rate)) rates[i] = rate;
  }
  return rates;
}

}  // namespace

void UnseenAlong::add(Run& done) {
  const std::size_t width = done.y.size(), before = count_ * width;
  count_ += done.rows;
  if (unseen_.empty() && done.unseen_at_end.empty()) return;
  if (before == 0 && unseen_.empty()) {
    unseen_ = done.unseen_at_end;
    rows_ = std::move(done.unseen);
    rows_.resize(count_ * width);
    return;
  }
  unseen_.resize(width);
  rows_.resize(before);
  rows_.resize(count_ * width);
  double* row = rows_.data() + before;
  for (std::size_t i = 0; i < done.rows; ++i, row += width) std::ranges::copy(unseen_, row);
  row = rows_.data() + before;
  for (const double in_run : done.unseen) *row++ += in_run;
  for (std::size_t k = 0; k < done.unseen_at_end.size(); ++k) unseen_[k] += done.unseen_at_end[k];
}

void UnseenAlong::doubt_instant(const SectionEnd& impact, double late) {
  const std::size_t n = impact.before.size() / 2;
  unseen_.resize(2 * n);
  const std::vector<double> of_map = rates_of_map(impact, late);
  for (std::size_t i = 0; i < n; ++i) {
    const double rate = std::abs(impact.slopes_before[n + i]) + std::abs(impact.slopes_after[n + i]);
    unseen_[i] += late * std::abs(impact.after[n + i] - impact.before[n + i]);
    unseen_[n + i] += late * (rate + std::abs(of_map[n + i]));
  }
}

void UnseenAlong::doubt_side(const SectionEnd& kink, double near, std::span<const double> grid) {
  const std::size_t n = kink.before.size() / 2;
  std::vector<double> off(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    off[n + i] = near * std::abs(kink.slopes_after[n + i] - kink.slopes_before[n + i]);
    off[i] = near * off[n + i];
  }
  const auto first = std::ranges::lower_bound(grid, kink.t - near);
  for (auto t = first; t != grid.end() && *t <= kink.t + near; ++t) {
    std::vector<double>& row = doubted_[static_cast<std::size_t>(t - grid.begin())];
    row.resize(2 * n);
    for (std::size_t k = 0; k < 2 * n; ++k) row[k] += off[k];
  }
}

std::vector<double> UnseenAlong::take_rows() {
  for (const auto& [row, off] : doubted_) {
    if (row >= count_) continue;
    rows_.resize(count_ * off.size());
    for (std::size_t k = 0; k < off.size(); ++k) rows_[row * off.size() + k] += off[k];
  }
  return std::move(rows_);
}

}  // namespace qdot
