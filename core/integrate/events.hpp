#pragma once
// Zeros of event functions g(t, y(t)), found on the dense output of each step.
//
// An event is a change of sign: g has one strict sign, later the other. Zeros between the two do not matter,
// so a function that touches zero and turns back does not count, and one that is exactly zero at a step's end
// is decided when it leaves zero. Each step is looked at in `pieces` pieces of equal length; two crossings
// within one piece are not seen. A pole, such as tan has, changes sign too, but its values grow towards the
// place, and so it does not count.
//
// A zero at t_start does not count either, whether g is exactly zero there or crosses within 1e-9 of the
// first step. That is where a motion goes on after the same event has ended an earlier one.
// Later crossings count.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/integrate/stepper.hpp"
#include "core/numerics/root.hpp"

namespace qdot {

/// How many occurrences one run reports at most; one more is an Error(too_large).
inline constexpr std::size_t most_occurrences = 50'000;

class EventSearch {
 public:
  static constexpr int pieces = 5;

  /// Keeps the reference to the request; the run starts at its (t_start, y_start).
  explicit EventSearch(const RunRequest& request);

  /// What happened in the stepper's last step.
  struct Found {
    std::vector<EventOccurrence> events;  ///< by time; those of one instant (to round-off) by index
    bool terminal{false};                 ///< the last of them ends the run; nothing after it is reported
    std::optional<Ending> failure;        ///< the dense output failed: nothing is known about this step
  };
  [[nodiscard]] Found search(Stepper& stepper);

 private:
  /// g at the last place looked at, and the strict sign it had last: 0 while it has had none since t_start.
  struct Probe {
    double value{};
    int sign{};
  };

  /// Whether a rough look at the last step shows that no event function comes near a change of sign in it;
  /// the probes are then at its end.
  bool is_quiet(Stepper& stepper);
  void search_piece(Stepper& stepper, double from, double to, Found& found);
  /// Takes note of g(to); true if g has crossed, in the direction asked for, since the probe before.
  static bool crosses(const EventFunction& event, Probe& probe, double value);
  std::optional<double> locate(Stepper& stepper, const EventFunction& event, SignChange bracket,
                               Found& found);
  void report(Stepper& stepper, std::vector<std::pair<double, std::size_t>> zeros, Found& found);

  const RunRequest& request_;
  double first_time_;  ///< zeros up to here are the start's
  std::vector<Probe> probes_;
  std::vector<double> y_;  ///< scratch
};

}  // namespace qdot
