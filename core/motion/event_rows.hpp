#pragma once
// Rows at the instants of a motion's events, and where it nearly meets one that would change its way, beside
// those of its grid, so that what other computations of the motion say of an event's time is said at that
// time.
//
// A row at an impact is before it. Where an event comes so near to an impact, or to where a piece ends, that
// it may be on either side of it in another computation, it has none.

#include <optional>
#include <span>
#include <vector>

#include "core/motion/simulation.hpp"

namespace qdot {

class EventRows {
 public:
  /// Of the events up to the last row that the motion reached.
  EventRows(std::span<const double> grid, const Simulation& motion);

  /// Both in one order: what other computations are asked for.
  [[nodiscard]] const std::vector<double>& instants() const { return instants_; }
  /// Instants of events and of approaches, increasing.
  [[nodiscard]] const std::vector<double>& events() const { return events_; }
  /// Whether the grid has this one of instants().
  [[nodiscard]] bool is_row(std::size_t instant) const { return is_row_[instant]; }
  /// The number of an event's instant among events().
  [[nodiscard]] std::optional<std::size_t> place(double t) const;

  /// Of a computation with a row for each of instants(): those of events go to its at_events.
  void set_apart(Simulation& simulation, std::size_t width) const;

 private:
  void add_approaches(std::span<const double> grid, const Simulation& motion);

  std::vector<double> instants_, events_;
  std::vector<bool> is_row_, is_event_;  ///< for each instant
};

}  // namespace qdot
