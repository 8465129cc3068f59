#include "core/motion/error_growth.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/row_errors.hpp"
#include "core/numerics/rough_powers.hpp"

namespace qdot {
namespace {

constexpr double long_enough = 0.125;  ///< of the motion: what is seen before does not tell how it grows
constexpr double late = 0.5;           ///< the rest is worth its cost
constexpr double exponential = 3;      ///< p from which on it is that
constexpr double most_growth_in_doublings = 60;

}  // namespace

ErrorGrowth::ErrorGrowth(const ComputedMotion& motion, std::vector<double> wanted)
    : motion_(motion), wanted_(std::move(wanted)) {}

double ErrorGrowth::time(std::size_t row) const { return motion_.grid.t[row] - motion_.request.t_start; }

bool ErrorGrowth::add(std::size_t first, std::span<const double> rows) {
  const std::size_t width = wanted_.size(), end = first + rows.size() / width;
  double largest = excess_.empty() ? 0 : excess_.back();
  for (; seen_ < end && excess_.size() < motion_.simulation.rows; ++seen_) {
    if (!motion_.event_rows.is_row(seen_)) continue;
    if (seen_ >= first)
      largest = std::max(largest, excess_of(excess_.size(), rows.subspan((seen_ - first) * width, width)));
    excess_.push_back(largest);
  }
  if (largest <= 1) return true;
  const double part = time(excess_.size() - 1) / time(motion_.simulation.rows - 1);
  return !(part > long_enough && part < late);
}

double ErrorGrowth::excess_of(std::size_t row, std::span<const double> other) const {
  const double* own = motion_.simulation.states.data() + row * wanted_.size();
  double largest = 0;
  for (std::size_t k = 0; k < wanted_.size(); ++k) {
    if (wanted_[k] == 0) continue;  // a column of zeros
    largest = std::max(largest, safety_of_differences * std::abs(own[k] - other[k]) / wanted_[k]);
  }
  return largest;
}

double ErrorGrowth::expected() const {
  const double now = excess_.back(), t = time(excess_.size() - 1), t_end = time(motion_.simulation.rows - 1);
  const auto half = std::ranges::lower_bound(motion_.grid.t, motion_.request.t_start + t / 2);
  const double before = excess_[static_cast<std::size_t>(half - motion_.grid.t.begin())];
  const double p = before > 0 ? std::max(1.0, rough_log2(now) - rough_log2(before)) : 1;
  const double doublings =
      p < exponential ? p * (rough_log2(t_end) - rough_log2(t)) : 2 * p * (t_end / t - 1);
  return now * rough_exp2(std::min(doublings, most_growth_in_doublings));
}

}  // namespace qdot
