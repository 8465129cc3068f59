#include "tests/calibration/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace qdot::test {
namespace {

bool meets(const Asked& asked, const ColumnOutcome& column) {
  const double wanted =
      asked.goal.kind == AccuracyGoal::Kind::relative ? asked.goal.value * column.scale : asked.goal.value;
  return column.true_error <= wanted;
}

/// Where errors are stated up to three times too large, the stated horizon comes as much earlier.
bool right_horizon(const Asked& asked, const Outcome& outcome) {
  const auto& stated = outcome.measured.horizon;
  if (!outcome.true_horizon) return true;
  if (!stated) return false;
  const std::vector<double>& grid = asked.request.grid;
  const auto place = std::lower_bound(grid.begin(), grid.end(), *stated);
  const double next = place + 1 < grid.end() ? *(place + 1) : *place;
  const double start = asked.request.t_start;
  return next - start >= 0.8 * (*outcome.earliest_horizon - start) &&
         *stated - start <= 1.2 * (*outcome.true_horizon - start);
}

}  // namespace

std::string Tally::judge(const ColumnOutcome& column) {
  ++columns_;
  std::ostringstream remark;
  remark.precision(3);
  const bool too_small = column.true_error > column.stated;
  const bool above_round_off = column.stated > round_off_level * column.scale;
  const bool too_large = above_round_off && column.stated > overstated * column.true_error;
  if (above_round_off && column.stated > 0) times_too_large_.push_back(column.stated / column.true_error);
  understated_ += too_small;
  overstated_ += too_large;
  if (too_small) remark << "  UNDERSTATED ";
  if (too_large) remark << "  overstated ";
  if (too_small || too_large) {
    remark << column.name << ": stated " << column.stated << ", true " << column.true_error << ", scale "
           << column.scale << '\n';
  }
  return remark.str();
}

std::string Tally::add(const Asked& asked, const Outcome& outcome) {
  ++requests_;
  ++endings_[outcome.status()];
  cpu_ += outcome.cpu;
  reference_cpu_ += outcome.reference_cpu;
  if (outcome.failed() || outcome.columns.empty()) return {};
  if (outcome.measured.max_abs_error.empty()) {
    ++unmeasured_;
    return "  unmeasured: " + outcome.measured.reason + "\n";
  }
  if (outcome.known_rows == 0) {
    ++unknown_;
    return "  no reference\n";
  }
  std::string remarks;
  const bool whole = outcome.known_rows == outcome.measured.simulation.rows;
  for (const ColumnOutcome& column : outcome.columns) {
    if (whole || column.true_error > column.stated) remarks += judge(column);
    if (outcome.measured.meets_request == true && !meets(asked, column)) {
      ++broken_promises_;
      remarks += "  BROKEN PROMISE in " + column.name + "\n";
    }
  }
  if (!whole) ++unknown_;
  if (outcome.true_horizon) {
    ++horizons_;
    if (!right_horizon(asked, outcome)) {
      ++wrong_horizons_;
      std::ostringstream remark;
      remark << "  HORIZON stated " << outcome.measured.horizon.value_or(-1) << ", true "
             << *outcome.true_horizon << '\n';
      remarks += remark.str();
    }
  }
  return remarks;
}

double Tally::times_too_large(double share) const {
  if (times_too_large_.empty()) return 0;
  std::vector<double> sorted = times_too_large_;
  std::ranges::sort(sorted);
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

std::string Tally::summary() const {
  std::ostringstream out;
  const auto share = [&](std::uint64_t n, std::uint64_t of) {
    return " (" +
           std::to_string(100.0 * static_cast<double>(n) /
                          static_cast<double>(std::max<std::uint64_t>(of, 1))) +
           " %)";
  };
  out << requests_ << " requests, " << columns_ << " columns compared\n"
      << understated_ << " understated" << share(understated_, columns_) << ", " << overstated_
      << " overstated" << share(overstated_, columns_) << ", " << broken_promises_ << " broken promises\n"
      << "stated / true above round-off: median " << times_too_large(0.5) << ", 90 % below "
      << times_too_large(0.9) << '\n'
      << wrong_horizons_ << " of " << horizons_ << " horizons wrong\n"
      << unmeasured_ << " answers without an error, " << unknown_
      << " that the reference did not reach the end of\n";
  for (const auto& [name, n] : endings_) out << "  " << n << ' ' << name << '\n';
  out << "CPU " << cpu_ << " s, reference " << reference_cpu_ << " s\n";
  return out.str();
}

bool Tally::passes() const {
  return understates_nothing() && static_cast<double>(overstated_) <= 0.1 * static_cast<double>(columns_) &&
         broken_promises_ == 0;
}

std::string description(const Outcome& outcome) {
  std::ostringstream out;
  out.precision(3);
  const MeasuredSimulation& m = outcome.measured;
  out << outcome.status() << ", t " << m.simulation.t << ", rows " << m.simulation.rows << ", known "
      << outcome.known_rows << ", rtol " << m.tolerances.rtol << ", evaluations " << m.evaluations
      << ", steps " << m.simulation.steps;
  if (m.meets_request) out << (*m.meets_request ? ", met" : ", not met");
  if (m.horizon) out << ", horizon " << *m.horizon;
  for (const ColumnOutcome& c : outcome.columns)
    out << "; " << c.name << ' ' << c.stated << '/' << c.true_error;
  return out.str();
}

}  // namespace qdot::test
