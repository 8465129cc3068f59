#include "core/motion/kept_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/compile/tape_evaluator.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_looked_at = 8;  ///< rows: of each part of the motion that where most has changed
constexpr double of_second_order = 2;
constexpr double of_rounding = 64 * std::numeric_limits<double>::epsilon();
constexpr double least_difference = 1e-7;  ///< for a slope, relative

/// All conserved quantities of a system, and what errors of a state do to each.
class Quantities {
 public:
  Quantities(const Dynamics& dynamics, const Reals& parameters)
      : conserved_(dynamics.conserved(parameters)),
        parameters_(parameters.as<Interval>()),
        workspace_(count() == 0 ? Workspace() : conserved_->values->bind(parameters)) {}

  [[nodiscard]] std::size_t count() const { return conserved_->quantities.size(); }
  [[nodiscard]] const std::string& name(std::size_t k) const { return conserved_->quantities[k].name; }

  /// Not a number where there is no value.
  [[nodiscard]] std::vector<double> at(double t, std::span<const double> y) {
    std::vector<double> values(count());
    take(t, y, values);
    return values;
  }
  void take(double t, std::span<const double> y, std::vector<double>& values) {
    if (conserved_->values->evaluate(t, y, workspace_, values) == Evaluation::ok) return;
    std::ranges::fill(values, std::numeric_limits<double>::quiet_NaN());
  }

  /// Whether the errors of a state explain a change: no more is computed than it takes to know that they do.
  [[nodiscard]] bool explain(std::size_t quantity, double change, double t, std::vector<double> y,
                             std::span<const double> errors) {
    double of_errors = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
      of_errors += slope(quantity, t, y, errors, k) * errors[k];
      if (!(change - of_second_order * of_errors > 0)) return true;
    }
    return false;
  }

  struct Effect {
    double of_errors{};
    double size{};      ///< of the terms that it is the sum of, roughly
    double rounding{};  ///< of its value at that state
  };
  [[nodiscard]] Effect effect(std::size_t quantity, double t, std::vector<double> y,
                              std::span<const double> errors) {
    Effect effect{0, std::abs(at(t, y)[quantity]), rounding(quantity, t, y)};
    const double dt = least_difference * std::abs(t);
    if (dt > 0) effect.size += std::abs(at(t + dt, y)[quantity] - at(t, y)[quantity]) / least_difference;
    for (std::size_t k = 0; k < y.size(); ++k) {
      const double by = slope(quantity, t, y, errors, k);
      effect.of_errors += by * errors[k];
      effect.size += by * std::abs(y[k]);
    }
    return effect;
  }

 private:
  [[nodiscard]] double rounding(std::size_t quantity, double t, std::span<const double> y) const {
    TapeEvaluator<Interval> enclosed(*conserved_->values, parameters_);
    enclosed.set_time(t);
    std::vector<Interval> values(count());
    enclosed(std::vector<Interval>(y.begin(), y.end()), values);
    return values[quantity].upper - values[quantity].lower;
  }

  /// |dQ/dy_k|; 0 where it makes no difference.
  [[nodiscard]] double slope(std::size_t quantity, double t, std::vector<double>& y,
                             std::span<const double> errors, std::size_t k) {
    const double place = y[k], h = std::max(errors[k], least_difference * std::abs(place));
    if (h == 0) return 0;
    y[k] = place + h;
    const double beyond = at(t, y)[quantity];
    y[k] = place - h;
    const double slope = std::abs(beyond - at(t, y)[quantity]) / (2 * h);
    y[k] = place;
    return slope;
  }

  std::shared_ptr<const Conserved> conserved_;
  std::vector<Interval> parameters_;
  Workspace workspace_;
};

class Comparison {
 public:
  Comparison(Quantities& quantities, const StatedRows& rows, std::span<const SectionRecord> sections)
      : quantities_(quantities), rows_(rows), sections_(sections) {}

  [[nodiscard]] bool has_changed(std::size_t quantity) {
    const std::vector<std::size_t> places = most_changed(quantity);
    const auto is_explained = [&](std::size_t i) {
      return quantities_.explain(quantity, change(quantity, i), rows_.t[i], copy(state(i)), errors(i));
    };
    if (std::ranges::all_of(places, is_explained)) return false;
    double unexplained = 0, size = 0, rounding = 0;
    for (const std::size_t i : places) {
      const auto here = quantities_.effect(quantity, rows_.t[i], copy(state(i)), errors(i));
      const Place begin = begin_of(i);
      const auto there = quantities_.effect(quantity, begin.t, copy(begin.y), errors(i));
      const double explained = of_second_order * (here.of_errors + there.of_errors);
      unexplained = std::max(unexplained, change(quantity, i) - explained);  // not a number: explained
      size = std::max({size, here.size, there.size});
      rounding = std::max(rounding, here.rounding + there.rounding);
    }
    return unexplained - rounding > of_rounding * size;
  }

 private:
  struct Place {
    double t{};
    std::span<const double> y;
  };

  [[nodiscard]] static std::vector<double> copy(std::span<const double> y) { return {y.begin(), y.end()}; }
  [[nodiscard]] std::span<const double> state(std::size_t i) const {
    return rows_.states.subspan(i * rows_.start.size(), rows_.start.size());
  }
  [[nodiscard]] std::span<const double> errors(std::size_t i) const {
    return rows_.errors.subspan(i * rows_.start.size(), rows_.start.size());
  }
  [[nodiscard]] double change(std::size_t quantity, std::size_t i) const {
    return rows_.changes[i * quantities_.count() + quantity];
  }
  /// Where the section began that the row is in.
  [[nodiscard]] Place begin_of(std::size_t i) const {
    const auto next = std::ranges::lower_bound(sections_, rows_.t[i], {}, &SectionRecord::t);
    if (next == sections_.begin()) return {rows_.t_start, rows_.start};
    return {(next - 1)->t, (next - 1)->after};
  }

  /// Of each part of the motion one row.
  [[nodiscard]] std::vector<std::size_t> most_changed(std::size_t quantity) const {
    std::vector<std::size_t> places;
    const std::size_t count = rows_.t.size(), parts = std::min(count, most_looked_at);
    for (std::size_t part = 0; part < parts; ++part)
      places.push_back(most_changed(quantity, part * count / parts, (part + 1) * count / parts));
    return places;
  }

  [[nodiscard]] std::size_t most_changed(std::size_t quantity, std::size_t from, std::size_t to) const {
    for (std::size_t i = from; i < to; ++i) {
      if (change(quantity, i) > change(quantity, from)) from = i;
    }
    return from;
  }

  Quantities& quantities_;
  const StatedRows& rows_;
  std::span<const SectionRecord> sections_;
};

}  // namespace

std::string changed_conserved_quantity(const Dynamics& dynamics, const Reals& parameters,
                                       const StatedRows& rows, std::span<const SectionRecord> sections) {
  Quantities quantities(dynamics, parameters);
  if (rows.changes.empty()) return {};
  Comparison comparison(quantities, rows, sections);
  for (std::size_t k = 0; k < quantities.count(); ++k) {
    if (comparison.has_changed(k)) return quantities.name(k);
  }
  return {};
}

}  // namespace qdot
