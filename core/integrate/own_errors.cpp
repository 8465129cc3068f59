#include "core/integrate/own_errors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/integrate/bounded_steps.hpp"

namespace qdot {
namespace {

constexpr double rounding = 0x1p-53;
/// Of what a component has reached: so far away a motion is still one that goes beside it.
constexpr double small_part = 1e-3;

double sign(RandomBits& random) { return random() % 2 == 0 ? 1 : -1; }

}  // namespace

OwnErrors::OwnErrors(const Originals& originals, const Apart& start, double t)
    : by_truncation_(originals.asked, start.by_truncation),
      by_rounding_(originals.rounded, start.by_rounding),
      rises_(originals),
      random_(std::bit_cast<std::uint64_t>(t)),
      share_of_rounding_(start.share_of_rounding),
      terms_(start.by_truncation.size()),
      sizes_(start.by_truncation.size()),
      signs_(sizes_.size()),
      of_series_(sizes_.size()),
      hidden_(sizes_.size()) {
  RandomBits random(std::bit_cast<std::uint64_t>(t));
  for (std::size_t i = 0; i < sizes_.size() / 2; ++i) always_.push_back(sign(random));
  always_.insert(always_.end(), always_.begin(), always_.end());
}

bool OwnErrors::is_rounding_large() const {
  const std::vector<double>&e = by_rounding_.now(), &size = by_rounding_.reached();
  for (std::size_t i = 0; i < e.size(); ++i) {
    if (std::abs(e[i]) > small_part * size[i] && size[i] > 0) return true;
  }
  return false;
}

/// To the side where both add up along what has grown.
void OwnErrors::hand_over_rounding() {
  const std::vector<double>&e = by_rounding_.now(), &other = by_truncation_.now();
  double along = 0, by_rounding = 0, by_truncation = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double size = by_rounding_.reached()[i];
    if (!(size > 0)) continue;
    along += (e[i] / size) * (other[i] / size);
    by_rounding += std::abs(e[i]) / enlarged / size;
    by_truncation += std::abs(other[i]) / size;
  }
  for (std::size_t i = 0; i < e.size(); ++i) {
    sizes_[i] = std::abs(e[i]) / enlarged;
    signs_[i] = along < 0 ? -e[i] : e[i];
  }
  by_truncation_.add(sizes_, signs_);
  by_rounding_.begin_anew();
  share_of_rounding_ += (1 - share_of_rounding_) * by_rounding / (by_rounding + by_truncation);
}

void OwnErrors::follow(const MotionPiece& step) {
  terms_.take(step);
  if (is_rounding_large()) hand_over_rounding();
  rises_.find(step, terms_, by_truncation_, by_rounding_);
  by_rounding_.follow(step, terms_);
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    sizes_[i] = enlarged * rounding * terms_.largest()[i] * (0.5 + random_.fraction());
    signs_[i] = sign(random_);
  }
  by_rounding_.add(sizes_, signs_);
  if (!step.rounding.empty()) take_forces(step);
  if (step.defect.empty()) return by_truncation_.follow(step, terms_);
  const bool hides = find_hidden(step.h, step.rows, step.order, step.defect, hidden_);
  for (std::size_t i = 0; i < sizes_.size(); ++i) of_series_[i] = step.defect[i] * step.h / step.order;
  // One sample may be so small that last digits alone tell how it grows.
  by_truncation_.follow(step, terms_,
                        {.sizes = of_series_,
                         .sides = by_rounding_.now(),
                         .of_series = of_series_,
                         .acting = step.rounding.empty() ? std::span<const double>() : of_forces_,
                         .hidden = hides ? std::span<const double>(hidden_) : std::span<const double>(),
                         .longest_part = by_rounding_.shortest_part()});
}

/// What rounding of the accelerations does in a step.
void OwnErrors::take_forces(const MotionPiece& step) {
  const std::size_t n = step.rounding.size();
  of_forces_.resize(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    of_forces_[n + i] = step.rounding[i] * step.h;
    of_forces_[i] = of_forces_[n + i] * step.h / 2;
  }
  for (std::size_t i = 0; i < 2 * n; ++i)
    sizes_[i] = std::min(enlarged * of_forces_[i], small_part * by_rounding_.reached()[i]);
  by_rounding_.add(sizes_, always_);
}

}  // namespace qdot
