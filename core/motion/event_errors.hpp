#pragma once
// The error of the time of an event, from that of the states around it.
//
// An event is a zero of g(t, y). A motion that is within e_k of the true one in component k has its zero
// within tau of the true one, where
//
//   |g'| tau - |g''| tau^2 / 2 = |g| + sum_k |dg/dy_k| e_k  and what rounding does to g
//
// with g' and g'' along the motion, both of them measured at one place: right to second order in tau, an
// estimate as the e_k are, and no enclosure. Where this has no solution the motion grazes: whether it comes
// to a zero there is no more certain than the motion itself.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/motion/simulation.hpp"

namespace qdot {

class EventErrors {
 public:
  /// `scale`: the largest magnitude of each component of the state. Keeps references to what it is given.
  EventErrors(const Dynamics& dynamics, const SimulationRequest& request, std::span<const double> scale);

  /// In s; `errors` of the state at that time. Source: the implicit function theorem.
  [[nodiscard]] std::optional<double> of(const EventRecord& event, std::span<const double> errors);
  /// Of a condition of validity or a singularity that has ended the motion in state y.
  [[nodiscard]] std::optional<double> of(const Stop& stop, std::span<const double> y,
                                         std::span<const double> errors);

 private:
  [[nodiscard]] std::optional<double> of(const Watch& watch, double t, std::span<const double> y,
                                         std::span<const double> errors);
  [[nodiscard]] double doubt(const Watch& watch, double t, std::span<const double> y,
                             std::span<const double> errors) const;
  [[nodiscard]] std::vector<double> state_after(double tau, double t, std::span<const double> y);
  [[nodiscard]] std::vector<double> accelerations(double t, std::span<const double> y);

  const Dynamics& dynamics_;
  std::span<const double> scale_;
  std::vector<Watch> watches_;
  Workspace workspace_;
};

}  // namespace qdot
