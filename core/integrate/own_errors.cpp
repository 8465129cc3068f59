#include "core/integrate/own_errors.hpp"

#include <bit>
#include <cmath>

namespace qdot {
namespace {

constexpr double rounding = 0x1p-53;

}  // namespace

OwnErrors::OwnErrors(const Originals& originals, const Apart& start, double t)
    : by_truncation_(originals.asked, start.by_truncation),
      by_rounding_(originals.rounded, start.by_rounding),
      random_(std::bit_cast<std::uint64_t>(t)),
      terms_(start.by_truncation.size()),
      sizes_(terms_.size()),
      signs_(sizes_.size()) {}

void OwnErrors::follow(const MotionPiece& step) {
  largest_terms(step, terms_);
  by_truncation_.follow(step, terms_);
  by_rounding_.follow(step, terms_);
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    sizes_[i] = enlarged * rounding * terms_[i] * (0.5 + random_.fraction());
    signs_[i] = random_() % 2 == 0 ? 1 : -1;
  }
  by_rounding_.add(sizes_, signs_);
  if (step.defect.empty()) return;
  for (std::size_t i = 0; i < sizes_.size(); ++i) sizes_[i] = step.defect[i] * step.h / step.order;
  const std::size_t n = sizes_.size() - step.rounding.size();
  for (std::size_t i = 0; i < step.rounding.size(); ++i) {
    const double of_velocity = step.rounding[i] * step.h;
    sizes_[n + i] += of_velocity;
    sizes_[i] += of_velocity * step.h / 2;
  }
  by_truncation_.add(sizes_, by_rounding_.now());
}

}  // namespace qdot
