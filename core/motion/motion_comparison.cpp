#include "core/motion/motion_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/motion/all_row_errors.hpp"
#include "core/motion/event_comparison.hpp"
#include "core/motion/kept_quantities.hpp"
#include "core/motion/row_tables.hpp"
#include "core/motion/rows_at_impacts.hpp"
#include "core/motion/winding.hpp"
#include "core/numerics/pairs.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double only_rounding = 1e-9;
constexpr double useful = 1e-3;  ///< horizon: of a column's largest magnitude

/// What errors of each column are large or small beside: its largest magnitude, or where that is rounding of
/// other coordinates of its kind, such as of a ball that lies between others, a small part of theirs.
std::vector<double> scales_of(const ComputedMotion& motion) {
  std::vector<double> scales = largest_magnitudes(motion, Rows::all);
  const std::vector<double> of_kind = largest_of_kind(motion);
  for (std::size_t k = 0; k < scales.size(); ++k) scales[k] = std::max(scales[k], only_rounding * of_kind[k]);
  return scales;
}

class Comparing {
 public:
  Comparing(const ComputedMotion& motion, const std::vector<Simulation>& others)
      : motion_(motion),
        others_(others),
        width_(motion.width()),
        largest_(scales_of(motion)),
        at_impacts_(motion, largest_) {}

  RowComparison compare(double doubt, double lost_from) {
    RowComparison result;
    result.max_abs_error.resize(width_);
    const std::size_t rows = std::min(motion_.simulation.rows, others_.front().rows);
    const std::vector<double> stated = errors(rows, doubt, lost_from);
    note_rows_asked_for(rows, stated, result);
    result.changed = changed(stated);
    add_event_errors(stated, doubt, result);
    add_rows_at_impacts(rows, result);
    result.approaches =
        EventComparison(motion_, others_, {stated, doubt, largest_}, at_impacts_).approaches();
    if (!motion_.simulation.near_events.empty())
      result.near_events =
          EventComparison(motion_, others_, {stated, doubt, largest_}, at_impacts_).near_events();
    return result;
  }

 private:
  [[nodiscard]] std::vector<double> errors(std::size_t rows, double doubt, double lost_from) {
    std::vector<OtherRows> others;
    std::vector<std::vector<double>> beside_impacts;
    beside_impacts.reserve(others_.size());
    for (const Simulation& other : others_) {
      others.push_back({other.rows, other.states, other.apart, other.unseen, other.accelerations});
      if (!other.sections.empty())
        others.back().states = beside_impacts.emplace_back(on_side_of_motion(other, rows));
    }
    AllRowErrors all({motion_.grid.t, motion_.grid.left_out, motion_.simulation.states, largest_},
                     std::move(others), accelerations(),
                     [this] { return winding_coordinates(motion_.dynamics.model()); });
    std::vector<double> stated = all.first(rows, lost_from);
    for (std::size_t i = 0; doubt > 0 && i < stated.size(); ++i) stated[i] += doubt * largest_[i % width_];
    return stated;
  }

  /// States on the motion's side of impacts. Motions in double-doubles go through the motion's own impacts.
  [[nodiscard]] std::vector<double> on_side_of_motion(const Simulation& other, std::size_t rows) {
    std::vector<double> states = other.states;
    for (std::size_t row = 0; row < std::min(rows, other.rows); ++row) {
      const auto beside = at_impacts_.on_side_of_motion(other, motion_.grid.t[row]);
      if (beside) std::ranges::copy(*beside, states.begin() + static_cast<std::ptrdiff_t>(row * width_));
    }
    return states;
  }

  [[nodiscard]] AllRowErrors::AccelerationsAt accelerations() const {
    const CompiledFunction& function = motion_.dynamics.accelerations();
    return [this, &function, workspace = function.bind(motion_.request.parameters)](
               std::size_t row, std::span<double> a) mutable {
      const auto y = std::span(motion_.simulation.states).subspan(row * width_, width_);
      return function.evaluate(motion_.grid.t[row], y, workspace, a) == Evaluation::ok;
    };
  }

  /// Errors grow: those of the last row are the largest.
  void note_rows_asked_for(std::size_t rows, std::span<const double> stated, RowComparison& result) const {
    const auto error = [&](std::size_t row) { return stated.subspan(row * width_, width_); };
    std::size_t end = rows;
    while (end > 0 && !motion_.grid.wanted[end - 1]) --end;
    if (end == 0) return;
    std::ranges::copy(error(end - 1), result.max_abs_error.begin());
    if (is_useful(error(end - 1))) return;
    std::size_t first = 0;
    while (!motion_.grid.wanted[first] || is_useful(error(first))) ++first;
    result.horizon = motion_.grid.t[first];
  }

  [[nodiscard]] bool is_useful(std::span<const double> error) const {
    for (std::size_t k = 0; k < width_; ++k) {
      if (error[k] > useful * (largest_[k] > 0 ? largest_[k] : 1)) return false;  // also between rows
    }
    return true;
  }

  [[nodiscard]] std::string changed(const std::vector<double>& stated) const {
    const std::size_t count = stated.size() / width_, all = motion_.simulation.rows;
    const std::vector<double>& changes = motion_.simulation.changes;
    const StatedRows rows{.t_start = motion_.request.t_start,
                          .start = motion_.request.y_start,
                          .t = std::span(motion_.grid.t).first(count),
                          .states = std::span(motion_.simulation.states).first(stated.size()),
                          .errors = stated,
                          .changes = std::span(changes).first(all == 0 ? 0 : count * (changes.size() / all))};
    return changed_conserved_quantity(motion_.dynamics, motion_.request.parameters, rows,
                                      motion_.simulation.sections);
  }

  void add_event_errors(const std::vector<double>& stated, double doubt, RowComparison& result) {
    if (motion_.simulation.events.empty() && !motion_.simulation.stop) return;
    EventComparison events(motion_, others_, {stated, doubt, largest_}, at_impacts_);
    result.event_errors = events.of_events();
    result.stop_error = events.of_stop();
  }

  void add_rows_at_impacts(std::size_t rows, RowComparison& result) const {
    const Simulation& motion = motion_.simulation;
    const std::vector<double>& times = motion_.grid.t;
    std::size_t row = 0;
    for (std::size_t i = 0; i < result.event_errors.size(); ++i) {
      const double t = motion.events[i].t;
      if (!std::ranges::binary_search(motion.sections, t, {}, &SectionRecord::t)) continue;
      const double near = std::max(result.event_errors[i].value_or(EventError{}).time, time_round_off(t));
      while (row < rows && times[row] < t - near) ++row;
      for (; row < rows && times[row] <= t + near; ++row) {
        if (motion_.grid.wanted[row]) result.at_impacts.push_back(times[row]);
      }
    }
  }

  const ComputedMotion& motion_;
  const std::vector<Simulation>& others_;
  std::size_t width_;
  std::vector<double> largest_;  ///< scales_of(motion)
  RowsAtImpacts at_impacts_;
};

}  // namespace

std::vector<double> largest_magnitudes(const ComputedMotion& motion, Rows which) {
  const std::size_t width = motion.width(), rows = motion.simulation.rows;
  const std::vector<bool>& wanted = motion.grid.wanted;
  const bool all_count = which == Rows::all || std::ranges::find(wanted, false) == wanted.end();
  std::vector<double> largest(width);
  if (all_count) return largest_in_columns(std::span(motion.simulation.states).first(rows * width), width);
  for (std::size_t k = 0; k < width; k += 2) {
    const double* y = motion.simulation.states.data() + k;
    PairOfDoubles most{};
    for (std::size_t row = 0; row < rows; ++row, y += width) {
      if (wanted[row]) most = larger_or(magnitudes(pair_at(y)), most);
    }
    put_pair(&largest[k], most);
  }
  return largest;
}

std::vector<double> largest_of_kind(const ComputedMotion& motion) {
  const std::vector<double> largest = largest_magnitudes(motion, Rows::all);
  std::vector<double> scales = largest;
  const auto& coordinates = motion.dynamics.model().scene.coordinates;
  const std::size_t n = coordinates.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (coordinates[i].unit != coordinates[j].unit) continue;
      for (const std::size_t rates : {std::size_t{0}, n})
        scales[rates + i] = std::max(scales[rates + i], largest[rates + j]);
    }
  }
  return scales;
}

RowComparison compare(const ComputedMotion& motion, const std::vector<Simulation>& others, double doubt,
                      double lost_from) {
  return Comparing(motion, others).compare(doubt, lost_from);
}

}  // namespace qdot
