#include "core/motion/errors_at_events.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/motion/row_errors.hpp"
#include "core/numerics/same_bits.hpp"

namespace qdot {
namespace {

constexpr double part_of_own_time = 0.1;

std::span<const double> row_of(const std::vector<double>& table, std::size_t row, std::size_t width) {
  if (table.size() < (row + 1) * width) return {};
  return std::span(table).subspan(row * width, width);
}

}  // namespace

ErrorsAtEvents::ErrorsAtEvents(const ComputedMotion& motion, const std::vector<Simulation>& others,
                               std::span<const double> scale, RowsAtImpacts& at_impacts)
    : motion_(motion), others_(others), scale_(scale), at_impacts_(at_impacts), so_far_(motion.width()) {}

std::optional<std::vector<double>> ErrorsAtEvents::next(const EventRecord& event,
                                                        std::span<const double> of_rows) {
  const auto place = motion_.event_rows.place(event.t);
  if (!place || (place != last_ && !take(*place, event))) return std::nullopt;
  last_ = place;
  std::vector<double> error(so_far_);
  for (std::size_t k = 0; k < of_rows.size(); ++k) error[k] = std::max(error[k], of_rows[k]);
  const std::size_t n = error.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    const double tau = part_of_own_time * scale_[i] / scale_[n + i];
    if (!(tau > 0) || !std::isfinite(tau)) continue;
    const double of_coordinate = error[i], of_velocity = error[n + i];
    error[i] = hypotenuse(of_coordinate, tau * of_velocity);
    error[n + i] = hypotenuse(of_coordinate * (part_of_own_time * part_of_own_time) / tau, of_velocity);
  }
  return error;
}

std::vector<StateAsTold> ErrorsAtEvents::as_told(const EventRecord& event) const {
  const auto place = motion_.event_rows.place(event.t);
  std::vector<StateAsTold> result;
  for (std::size_t j = 0; j < others_.size() && place; ++j) {
    const Simulation& other = others_[j];
    const auto row = row_of(other.at_events.states, *place, motion_.width());
    const auto apart = row_of(other.at_events.apart, *place, motion_.width());
    if (row.empty() || apart.empty()) continue;
    const auto moved = other.sections.empty() ? std::nullopt : at_impacts_.on_side_of_motion(other, event.t);
    StateAsTold& told = result.emplace_back();
    const auto missed = row_of(other.at_events.unseen, *place, motion_.width());
    for (std::size_t k = 0; k < row.size(); ++k) {
      told.beside.push_back((moved ? (*moved)[k] : row[k]) - event.y[k]);
      told.errors.push_back(safety_of_differences * apart[k] + (missed.empty() ? 0 : missed[k]));
    }
  }
  return result;
}

/// The first event of an instant; the state of others there is one before all impacts of it.
bool ErrorsAtEvents::take(std::size_t place, const EventRecord& event) {
  std::vector<std::vector<double>> beside;
  std::vector<OtherRow> same;
  std::vector<double> unseen(motion_.width());
  beside.reserve(others_.size());
  for (const Simulation& other : others_) {
    const auto row = row_of(other.at_events.states, place, motion_.width());
    if (row.empty()) continue;
    auto moved = other.sections.empty() ? std::nullopt : at_impacts_.on_side_of_motion(other, event.t);
    same.push_back({moved ? beside.emplace_back(std::move(*moved)) : row,
                    row_of(other.at_events.apart, place, motion_.width())});
    const auto missed = row_of(other.at_events.unseen, place, motion_.width());
    for (std::size_t k = 0; k < missed.size(); ++k) unseen[k] = std::max(unseen[k], missed[k]);
  }
  if (same.empty()) return false;
  for (std::size_t k = 0; k < so_far_.size(); ++k)
    so_far_[k] = std::max(so_far_[k], error_of_row(k, event.y, same, unseen));
  return true;
}

}  // namespace qdot
