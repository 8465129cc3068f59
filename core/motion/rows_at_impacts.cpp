#include "core/motion/rows_at_impacts.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

constexpr double small_part = 1e-3;  ///< of a column

std::size_t impacts_before(const Simulation& simulation, double t) {
  const auto next = std::ranges::lower_bound(simulation.sections, t, {}, &SectionRecord::t);
  return static_cast<std::size_t>(next - simulation.sections.begin());
}

}  // namespace

RowsAtImpacts::RowsAtImpacts(const ComputedMotion& motion, std::span<const double> scale)
    : motion_(motion),
      scale_(scale),
      workspace_(motion.dynamics.accelerations().bind(motion.request.parameters)) {}

std::optional<std::vector<double>> RowsAtImpacts::on_side_of_motion(const Simulation& other, double t) {
  if (other.sections.empty() && motion_.simulation.sections.empty()) return std::nullopt;
  const std::size_t own = impacts_before(motion_.simulation, t), others = impacts_before(other, t);
  const std::size_t k = std::min(own, others);
  if (std::max(own, others) != k + 1) return std::nullopt;
  if (k >= other.sections.size() || k >= motion_.simulation.sections.size()) return std::nullopt;
  const SectionRecord& impact = other.sections[k];
  std::vector<double> y = own == k ? impact.before : impact.after;
  const auto rates = slopes(impact.t, y);
  if (!rates || !is_short(impact.t - motion_.simulation.sections[k].t, *rates)) return std::nullopt;
  const double later = t - impact.t;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += later * (*rates)[i];
  return y;
}

/// (q', q'') at a state.
std::optional<std::vector<double>> RowsAtImpacts::slopes(double t, std::span<const double> y) {
  const std::size_t n = y.size() / 2;
  std::vector<double> result(y.begin() + static_cast<std::ptrdiff_t>(n), y.end());
  result.resize(2 * n);
  const auto accelerations = std::span(result).last(n);
  if (motion_.dynamics.accelerations().evaluate(t, y, workspace_, accelerations) != Evaluation::ok)
    return std::nullopt;
  return result;
}

bool RowsAtImpacts::is_short(double duration, std::span<const double> slopes) const {
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (!(std::abs(duration * slopes[i]) <= small_part * scale_[i])) return false;
  }
  return true;
}

}  // namespace qdot
