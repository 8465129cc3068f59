#include "core/motion/event_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double nearly_at_once = 1e3;  ///< round-offs of t

/// Where one part of the motion ends and another begins.
std::vector<double> ends_of_parts(const Simulation& motion) {
  std::vector<double> ends;
  for (const SectionRecord& section : motion.sections) ends.push_back(section.t);
  for (const PieceRecord& piece : motion.pieces) ends.push_back(piece.t);
  std::ranges::sort(ends);
  return ends;
}

/// Whether one of these instants, in order, is near t, but not t itself.
bool is_beside(std::span<const double> instants, double t) {
  const double near = nearly_at_once * time_round_off(t);
  for (auto i = std::ranges::lower_bound(instants, t - near); i != instants.end() && *i <= t + near; ++i) {
    if (*i != t) return true;
  }
  return false;
}

/// Takes the rows that are `wanted` out of a table.
std::vector<double> rows_where(const std::vector<bool>& wanted, std::size_t count, std::size_t width,
                               const std::vector<double>& all) {
  std::vector<double> rows;
  if (width == 0 || all.empty()) return rows;
  for (std::size_t i = 0; i < std::min(count, all.size() / width); ++i) {
    const double* row = all.data() + i * width;
    if (wanted[i]) rows.insert(rows.end(), row, row + width);
  }
  return rows;
}

}  // namespace

EventRows::EventRows(std::span<const double> grid, const Simulation& motion) {
  const std::vector<double> ends = ends_of_parts(motion);
  for (const EventRecord& event : motion.events) {
    if (motion.rows == 0 || event.t > grid[motion.rows - 1]) break;
    if (!events_.empty() && events_.back() == event.t) continue;
    if (!is_beside(ends, event.t)) events_.push_back(event.t);
  }
  add_approaches(grid, motion);
  instants_.reserve(grid.size() + events_.size());
  std::ranges::set_union(grid, events_, std::back_inserter(instants_));
  is_row_.resize(instants_.size(), events_.empty());
  is_event_.resize(instants_.size());
  for (std::size_t i = 0; i < instants_.size() && !events_.empty(); ++i) {
    is_row_[i] = std::ranges::binary_search(grid, instants_[i]);
    is_event_[i] = std::ranges::binary_search(events_, instants_[i]);
  }
}

void EventRows::add_approaches(std::span<const double> grid, const Simulation& motion) {
  for (const auto* approaches : {&motion.approaches, &motion.near_events}) {
    for (const ApproachRecord& approach : *approaches) {
      const double t = approach.place.instant();
      if (motion.rows > 0 && t <= grid[motion.rows - 1]) events_.push_back(t);
    }
  }
  std::ranges::sort(events_);
  events_.erase(std::unique(events_.begin(), events_.end()), events_.end());
}

std::optional<std::size_t> EventRows::place(double t) const {
  const auto found = std::ranges::lower_bound(events_, t);
  if (found == events_.end() || *found != t) return std::nullopt;
  return static_cast<std::size_t>(found - events_.begin());
}

void EventRows::set_apart(Simulation& simulation, std::size_t width) const {
  if (events_.empty()) return;
  const std::size_t count = simulation.rows;
  const auto split = [&](std::vector<double>& table, std::size_t columns) {
    std::vector<double> at_events = rows_where(is_event_, count, columns, table);
    table = rows_where(is_row_, count, columns, table);
    return at_events;
  };
  simulation.at_events.states = split(simulation.states, width);
  simulation.at_events.unseen = split(simulation.unseen, width);
  simulation.at_events.apart = split(simulation.apart, width);
  (void)split(simulation.apart_by_rounding, width);
  (void)split(simulation.accelerations, width / 2);
  const auto end = is_row_.begin() + static_cast<std::ptrdiff_t>(count);
  simulation.rows = static_cast<std::size_t>(std::count(is_row_.begin(), end, true));
}

}  // namespace qdot
