#pragma once
// How far what a motion keeps has drifted over its rows: conserved quantities and constraints.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/motion/simulation_request.hpp"

namespace qdot {

struct ConservedRecord {
  std::string name;
  std::string unit;
  double initial{};
  double max_abs_drift{};               ///< over the returned rows
  std::optional<double> max_rel_drift;  ///< over |initial|; no value where that is 0
};

/// How far the returned rows are from a constraint.
struct ConstraintRecord {
  std::string name;
  std::optional<double> max_abs_value;  ///< of phi; none of a constraint in the velocities
  double max_abs_rate{};                ///< of w
};

/// What lies between two impacts: drift is counted from its beginning, as what an impact takes is no drift.
struct Segment {
  std::size_t first_row{};
  double t{};
  std::vector<double> y;
};

/// By how much each conserved quantity has changed since its segment began: rows x quantities, of the first
/// rows of the request's grid, `states` being their states. Not a number where there is no value. Of one row
/// in so many, the last among them, where `every` is more than 1.
[[nodiscard]] std::vector<double> conserved_changes(const Dynamics& dynamics,
                                                    const SimulationRequest& request,
                                                    std::span<const double> states,
                                                    std::span<const Segment> segments, std::size_t every = 1);

/// The largest of these; none where one of them is not a number.
[[nodiscard]] std::vector<ConservedRecord> conserved_records(const Dynamics& dynamics,
                                                             const SimulationRequest& request,
                                                             std::span<const double> changes);
[[nodiscard]] std::vector<ConstraintRecord> constraints_along(const Dynamics& dynamics,
                                                              const SimulationRequest& request,
                                                              std::span<const double> states);

/// Whether an impact from `before` to `after` at time t leaves what constraints ask for: one that is derived
/// does, one that is written has to.
[[nodiscard]] bool keeps_constraints(const Dynamics& dynamics, const SimulationRequest& request, double t,
                                     std::span<const double> before, std::span<const double> after);

}  // namespace qdot
