#include "core/motion/motion_comparison.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/motion/event_comparison.hpp"
#include "core/motion/kept_quantities.hpp"
#include "core/motion/row_errors.hpp"
#include "core/motion/rows_at_impacts.hpp"
#include "core/motion/winding.hpp"
#include "core/numerics/pairs.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double part = 0.1;  ///< of its own time, in which no difference changes its sign twice
constexpr double only_rounding = 1e-9;
constexpr double useful = 1e-3;  ///< horizon: of a column's largest magnitude

/// What the checks may have missed up to a row.
void take_unseen(const std::vector<Simulation>& others, std::size_t row, std::vector<double>& unseen) {
  std::ranges::fill(unseen, 0.0);
  for (const Simulation& other : others) {
    if (other.unseen.empty() || row >= other.rows) continue;
    const double* of_row = other.unseen.data() + row * unseen.size();
    double* const most = unseen.data();
    for (std::size_t k = 0; k < unseen.size(); k += 2)
      put_pair(most + k, larger_or(pair_at(of_row + k), pair_at(most + k)));
  }
}

/// What errors of each column are large or small beside: its largest magnitude, or where that is rounding of
/// other coordinates of its kind, such as of a ball that lies between others, a small part of theirs.
std::vector<double> scales_of(const ComputedMotion& motion) {
  std::vector<double> scales = largest_magnitudes(motion, Rows::all);
  const std::vector<double> of_kind = largest_of_kind(motion);
  for (std::size_t k = 0; k < scales.size(); ++k) scales[k] = std::max(scales[k], only_rounding * of_kind[k]);
  return scales;
}

bool is_whole(double x) {
  constexpr double without_fractions = 0x1p53;
  return !(std::abs(x) < without_fractions) || x == static_cast<double>(static_cast<std::int64_t>(x));
}

/// Of a number that is not negative.
double next_above(double x) { return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + 1); }

class Comparing {
 public:
  Comparing(const ComputedMotion& motion, const std::vector<Simulation>& others)
      : motion_(motion),
        others_(others),
        width_(motion.width()),
        largest_(scales_of(motion)),
        at_impacts_(motion, largest_),
        errors_(largest_, [&] { return winding_coordinates(motion.dynamics.model()); }),
        workspace_(motion.dynamics.accelerations().bind(motion.request.parameters)),
        missed_(width_),
        acceleration_(width_ / 2),
        tau_(width_ / 2),
        difference_(width_) {
    for (std::size_t i = 0; i < tau_.size(); ++i) {
      const double tau = largest_[i] / largest_[tau_.size() + i];
      if (tau > 0 && std::isfinite(tau)) tau_[i] = tau;
    }
  }

  RowComparison compare(double doubt, double lost_from) {
    RowComparison result;
    result.max_abs_error.resize(width_);
    const std::size_t rows = std::min(motion_.simulation.rows, others_.front().rows);
    std::vector<double> stated(rows * width_);  // of each row
    for (std::size_t i = 0; i < rows; ++i) {
      if (motion_.grid.t[i] >= lost_from) errors_.lose();
      add(i);
      const std::span<double> error = std::span(stated).subspan(i * width_, width_);
      for (std::size_t k = 0; k < width_; ++k) error[k] = errors_.so_far()[k] + doubt * largest_[k];
    }
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
  [[nodiscard]] std::span<const double> row_of(const Simulation& simulation, std::size_t row) const {
    return std::span(simulation.states).subspan(row * width_, width_);
  }

  /// On the motion's side of an impact. Motions in double-doubles go through the motion's own impacts.
  [[nodiscard]] std::span<const double> state_of(const Simulation& other, std::size_t row) {
    if (other.sections.empty()) return row_of(other, row);
    auto beside = at_impacts_.on_side_of_motion(other, motion_.grid.t[row]);
    return beside ? beside_impacts_.emplace_back(std::move(*beside)) : row_of(other, row);
  }

  [[nodiscard]] std::span<const double> apart_of(const Simulation& simulation, std::size_t row) const {
    if (simulation.apart.empty()) return {};
    return std::span(simulation.apart).subspan(row * width_, width_);
  }

  void add(std::size_t row) {
    same_row_.clear();
    beside_impacts_.clear();
    beside_impacts_.reserve(others_.size());
    for (const Simulation& other : others_) {
      if (row < other.rows) same_row_.push_back({state_of(other, row), apart_of(other, row)});
    }
    take_unseen(others_, row, missed_);
    add_rounding_of_instant(row);
    add_slopes_of_differences(row);
    errors_.add(motion_.grid.t[row], row_of(motion_.simulation, row), same_row_, missed_);
  }

  void add_rounding_of_instant(std::size_t row) {
    const double t = motion_.grid.t[row];
    const double in_parts = t * 0x1p20, left_out = std::abs(motion_.grid.left_out[row]);
    const bool is_short = is_whole(in_parts);  // and so a decimal, too
    if (is_short && left_out == 0) return;
    const std::size_t n = width_ / 2;
    const std::span<const double> y = row_of(motion_.simulation, row);
    if (!take_accelerations(row)) return;
    const double rounded = is_short ? left_out : (next_above(std::abs(t)) - std::abs(t)) / 2;
    for (std::size_t i = 0; i < n; ++i) {
      missed_[i] += rounded * std::abs(y[n + i]);
      missed_[n + i] += rounded * std::abs(acceleration_[i]);
    }
  }

  /// Bounds of them near the row that a check has, or their values there.
  bool take_accelerations(std::size_t row) {
    const std::size_t n = width_ / 2;
    for (const Simulation& other : others_) {
      if (row >= other.rows || other.accelerations.empty()) continue;
      const auto bounds = std::span(other.accelerations).subspan(row * n, n);
      if (std::ranges::any_of(bounds, [](double a) { return std::isnan(a); })) continue;
      std::ranges::copy(bounds, acceleration_.begin());
      return true;
    }
    const double t = motion_.grid.t[row];
    const std::span<const double> y = row_of(motion_.simulation, row);
    return motion_.dynamics.accelerations().evaluate(t, y, workspace_, acceleration_) == Evaluation::ok;
  }

  /// A difference may be passing zero at a row, by chance, but then its slope is not zero: that of
  /// coordinates is the difference of velocities. So much it may be half-way to the next row, or a tenth of
  /// the motion's own time L_q / L_v away.
  void add_slopes_of_differences(std::size_t row) {
    const std::size_t n = width_ / 2;
    const std::span<const double> y = row_of(motion_.simulation, row);
    const std::vector<double>& t = motion_.grid.t;
    const double to_next = row + 1 < t.size() ? t[row + 1] - t[row] : row > 0 ? t[row] - t[row - 1] : 0;
    std::ranges::fill(difference_, 0.0);
    for (const auto& other : same_row_) {
      double* const most = difference_.data();
      for (std::size_t k = 0; k < 2 * n; k += 2) {
        const PairOfDoubles difference = magnitudes(pair_at(&y[k]) - pair_at(&other.row[k]));
        put_pair(most + k, larger_or(difference, pair_at(most + k)));
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double tau = tau_[i];
      if (tau == 0) continue;
      const double away = std::min(to_next / 2, part * tau);
      missed_[i] += away * difference_[n + i];
      missed_[n + i] += away / tau * (difference_[i] / tau);
    }
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
  RowErrors errors_;
  Workspace workspace_;
  std::vector<OtherRow> same_row_;                   ///< of the others
  std::vector<std::vector<double>> beside_impacts_;  ///< those of them that were moved
  std::vector<double> missed_, acceleration_;
  std::vector<double> tau_;         ///< L_q / L_v of each coordinate; 0 where that is no time
  std::vector<double> difference_;  ///< in a row, the largest of each column
};

}  // namespace

std::vector<double> largest_magnitudes(const ComputedMotion& motion, Rows which) {
  const std::size_t width = motion.width(), rows = motion.simulation.rows;
  const std::vector<bool>& wanted = motion.grid.wanted;
  const bool all_count = which == Rows::all || std::ranges::find(wanted, false) == wanted.end();
  std::vector<double> largest(width);
  for (std::size_t k = 0; k < width; k += 2) {
    const double* y = motion.simulation.states.data() + k;
    PairOfDoubles most{};
    for (std::size_t row = 0; row < rows; ++row, y += width) {
      if (all_count || wanted[row]) most = larger_or(magnitudes(pair_at(y)), most);
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
