#include "core/motion/motion_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/motion/kept_quantities.hpp"
#include "core/motion/row_errors.hpp"

namespace qdot {
namespace {

constexpr double useful = 1e-3;  ///< horizon: of a column's largest magnitude

/// What the checks may have missed up to a row; empty where there is nothing.
std::vector<double> unseen_at(const std::vector<Simulation>& others, std::size_t row, std::size_t width) {
  std::vector<double> unseen;
  for (const Simulation& other : others) {
    if (other.unseen.empty()) continue;
    unseen.resize(width);
    for (std::size_t k = 0; k < width; ++k) unseen[k] = std::max(unseen[k], other.unseen[row * width + k]);
  }
  return unseen;
}

class Comparing {
 public:
  Comparing(const ComputedMotion& motion, const std::vector<Simulation>& others)
      : motion_(motion),
        others_(others),
        width_(motion.width()),
        largest_(largest_magnitudes(motion, Rows::all)),
        scale_(largest_magnitudes(motion, Rows::wanted)),
        errors_(largest_),
        workspace_(motion.dynamics.accelerations().bind(motion.request.parameters)) {}

  RowComparison compare(double doubt) {
    RowComparison result{.max_abs_error = std::vector<double>(width_), .horizon = {}, .changed = {}};
    std::size_t rows = motion_.simulation.rows;
    for (const Simulation& other : others_) rows = std::min(rows, other.rows);
    std::vector<double> stated;  // of each row
    for (std::size_t i = 0; i < rows; ++i) {
      std::vector<double> error = at(i);
      for (std::size_t k = 0; k < width_; ++k) error[k] += doubt * largest_[k];
      stated.insert(stated.end(), error.begin(), error.end());
      if (!motion_.grid.wanted[i]) continue;
      if (!result.horizon && !is_useful(error)) result.horizon = motion_.grid.t[i];
      result.max_abs_error = std::move(error);
    }
    result.changed = changed(stated);
    return result;
  }

 private:
  [[nodiscard]] std::span<const double> row_of(const Simulation& simulation, std::size_t row) const {
    return std::span(simulation.states).subspan(row * width_, width_);
  }

  std::vector<double> at(std::size_t row) {
    std::vector<std::span<const double>> same_row;
    for (const Simulation& other : others_) same_row.push_back(row_of(other, row));
    std::vector<double> missed = unseen_at(others_, row, width_);
    add_rounding_of_instant(row, missed);
    errors_.add(row_of(motion_.simulation, row), same_row, missed);
    return errors_.so_far();
  }

  void add_rounding_of_instant(std::size_t row, std::vector<double>& missed) {
    const double t = motion_.grid.t[row];
    const double in_parts = std::ldexp(t, 20);
    if (in_parts == std::nearbyint(in_parts)) return;  // as it was typed
    const std::size_t n = width_ / 2;
    const std::span<const double> y = row_of(motion_.simulation, row);
    std::vector<double> acceleration(n);
    if (motion_.dynamics.accelerations().evaluate(t, y, workspace_, acceleration) != Evaluation::ok) return;
    missed.resize(width_);
    const double rounded = (std::nextafter(std::abs(t), infinity) - std::abs(t)) / 2;
    for (std::size_t i = 0; i < n; ++i) {
      missed[i] += rounded * std::abs(y[n + i]);
      missed[n + i] += rounded * std::abs(acceleration[i]);
    }
  }

  [[nodiscard]] bool is_useful(const std::vector<double>& error) const {
    for (std::size_t k = 0; k < width_; ++k) {
      if (error[k] > useful * scale_[k]) return false;
    }
    return true;
  }

  [[nodiscard]] std::string changed(const std::vector<double>& stated) const {
    const StatedRows rows{.t_start = motion_.request.t_start,
                          .start = motion_.request.y_start,
                          .t = std::span(motion_.grid.t).first(stated.size() / width_),
                          .states = std::span(motion_.simulation.states).first(stated.size()),
                          .errors = stated};
    return changed_conserved_quantity(motion_.dynamics, motion_.request.parameters, rows,
                                      motion_.simulation.sections);
  }

  const ComputedMotion& motion_;
  const std::vector<Simulation>& others_;
  std::size_t width_;
  std::vector<double> largest_, scale_;
  RowErrors errors_;
  Workspace workspace_;
};

}  // namespace

std::vector<double> largest_magnitudes(const ComputedMotion& motion, Rows which) {
  const std::size_t width = motion.width();
  std::vector<double> largest(width);
  for (std::size_t i = 0; i < motion.simulation.rows * width; ++i) {
    if (which == Rows::wanted && !motion.grid.wanted[i / width]) continue;
    largest[i % width] = std::max(largest[i % width], std::abs(motion.simulation.states[i]));
  }
  return largest;
}

RowComparison compare(const ComputedMotion& motion, const std::vector<Simulation>& others, double doubt) {
  return Comparing(motion, others).compare(doubt);
}

}  // namespace qdot
