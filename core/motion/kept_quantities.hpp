#pragma once
// Whether a motion keeps what it must keep, as far as the errors stated of it allow.
//
// A conserved C has one value along an exact motion. Along rows that are within e_k of one, in component k,
//
//   |C(y_i) - C(y_0)|  <=  sum_k |dC/dy_k| e_k  at row i, and the same at the start, and round-off
//
// to first order. Rows that go beyond contradict their errors: a particle that has crossed a wall without
// the energy for it, say. Twice the sum is allowed for what is of second order.

#include <span>
#include <string>
#include <vector>

#include "core/motion/simulation.hpp"

namespace qdot {

/// Rows of a motion with what is stated of each. Errors do not fall from row to row.
struct StatedRows {
  double t_start{};
  std::span<const double> start{};  ///< the state there
  std::span<const double> t{};
  std::span<const double> states{};   ///< rows x 2n, row-major
  std::span<const double> errors{};   ///< of these
  std::span<const double> changes{};  ///< rows x quantities, of what is conserved (drift.hpp)
};

/// The name of a conserved quantity that changes by more than the errors explain; empty where there is none.
/// At an impact it may jump: `sections` are those that the motion has. A row at an impact is before it.
[[nodiscard]] std::string changed_conserved_quantity(const Dynamics& dynamics, const Reals& parameters,
                                                     const StatedRows& rows,
                                                     std::span<const SectionRecord> sections);

}  // namespace qdot
