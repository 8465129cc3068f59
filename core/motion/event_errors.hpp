#pragma once
// The error of the time of an event, from that of the states around it.
//
// An event is a change of sign of g(t, y). A motion that is within e_k of the true one in component k has its
// change of sign within tau of the true one where g has one sign in all states within e_k of y(t - tau), and
// the other one in all those of y(t + tau): both by interval arithmetic, in twice the digits where doubles do
// not tell. Where the slope of g decides, tau is about
//
//   (|g| + sum_k |dg/dy_k| e_k)/|g'|,
//
// where the search for it begins; at a multiple root, or a level that is nearly touched, it may be any
// larger. In tau the e_k grow as well (states_beside.hpp). Where intervals are too wide to tell, slopes and
// curvatures do. Where no such tau exists, whether g changes sign at all is no more certain than the motion
// itself. That it does so once only, single_crossing.hpp proves in all states within tau, or slopes tell;
// else it may do so several times.
//
// The state there is off by e_k, and by what the motion changes it in tau.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/motion/measured_simulation.hpp"
#include "core/motion/states_beside.hpp"

namespace qdot {

class EventErrors {
 public:
  /// `scale`: the largest magnitude of each component of the state. Keeps references to what it is given.
  EventErrors(const Dynamics& dynamics, const SimulationRequest& request, std::span<const double> scale);

  /// `errors` of the state at that time, `reached`: what each component has reached up to it.
  [[nodiscard]] std::optional<EventError> of(const EventRecord& event, std::span<const double> errors,
                                             std::span<const double> reached);
  /// Of a condition of validity or a singularity that has ended the motion in state y; its time may be off by
  /// `at_least` so much.
  [[nodiscard]] std::optional<EventError> of(const Stop& stop, std::span<const double> y,
                                             std::span<const double> errors, double at_least);
  /// Of any place of the motion whose time may be off by so much.
  [[nodiscard]] std::optional<EventError> at(double t, std::span<const double> y,
                                             std::span<const double> errors, double time);
  /// Whether the motion passes zero of a reported event there, once, and not in the direction that is asked
  /// for.
  [[nodiscard]] bool passes_against(const EventRecord& place, std::span<const double> errors,
                                    std::span<const double> reached);
  /// Whether what stops the motion held before that impact and does not after it, by more than these errors.
  [[nodiscard]] bool breaks(const SectionRecord& impact, const Stop& stop,
                            std::span<const double> errors) const;

 private:
  [[nodiscard]] std::optional<EventError> of(const Watch& watch, double t, std::span<const double> y,
                                             std::span<const double> errors, std::span<const double> reached,
                                             double at_least = 0, double untold = 0);
  [[nodiscard]] static int sign_of(const Watch& watch, double t, std::span<const double> y,
                                   std::span<const double> errors);
  struct Place {
    StatesBeside states;
    double own_time{};  ///< in which the motion goes through one of its components
    double untold{};    ///< in which signs were not known
    bool cancels{};     ///< terms of the function change by more than it does
  };
  struct Time {
    double error{};
    bool is_single{};  ///< g passes zero once in it: by its slope, which is the same all that time
  };
  [[nodiscard]] std::optional<Time> time_of(const Watch& watch, Place& place, double shortest);
  [[nodiscard]] static std::optional<EventError> with_state(double time, StatesBeside& states);
  [[nodiscard]] std::optional<Time> by_slopes(const Watch& watch, Place& place, double doubt);
  [[nodiscard]] static bool passes_once(double tau, const Watch& watch, Place& place);
  [[nodiscard]] bool is_as_steep(double tau, double slope, const Watch& watch, Place& place);
  [[nodiscard]] bool is_clear_of_zero(double tau, const Watch& watch, Place& place);
  struct Linear {
    double doubt{};  ///< |g| + sum_k |dg/dy_k| e_k
    double slope{};  ///< of g along the motion
  };
  [[nodiscard]] Linear linear(const Watch& watch, const Place& place) const;
  [[nodiscard]] static std::vector<const Watch*> in_order_of_zeros(std::vector<const Watch*> all, double t,
                                                                   std::span<const double> y);
  [[nodiscard]] bool may_turn_before(double t, std::span<const double> y,
                                     std::span<const double> errors) const;
  [[nodiscard]] bool cancels(const Watch& watch, const Place& place, double doubt) const;
  [[nodiscard]] int sign_within(const Watch& watch, double t, std::span<const Interval> box,
                                bool cancels = false) const;
  [[nodiscard]] int sign_by_slopes(const Watch& watch, double t, std::span<const Interval> box) const;
  [[nodiscard]] std::optional<int> sign_after(double tau, const Watch& watch, Place& place);

  const Dynamics& dynamics_;
  const Reals& parameters_;
  std::span<const double> scale_;
  double t_start_;
  std::vector<Watch> watches_;
  Workspace workspace_;
};

}  // namespace qdot
