#pragma once
// A motion near one of its places, by its accelerations there: where it is some time before and after, and
// what its components may be off then, where they are within e_k at the place.
//
// In tau the e_k grow:
//
//   e_q + tau e_v + tau^2/2 e_a,   e_v + tau e_a,   e_a,i = sum_k |da_i/dy_k| e_k,
//
// and where the second order is not small any more, as beside the top of a hill, there is no result.
// It is as good as the e_k are, which are estimates.

#include <optional>
#include <span>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/dynamics/single_crossing.hpp"

namespace qdot {

class StatesBeside {
 public:
  /// Keeps references to all but the errors. The motion has begun at `t_start`.
  StatesBeside(const Dynamics& dynamics, Workspace& workspace, double t_start, double t,
               std::span<const double> y, std::vector<double> errors);

  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] std::span<const double> y() const { return y_; }
  [[nodiscard]] const std::vector<double>& errors() const { return errors_; }
  /// Not numbers where there are none.
  [[nodiscard]] const std::vector<double>& accelerations() const { return accelerations_; }
  /// Of component k along the motion.
  [[nodiscard]] double rate(std::size_t k) const {
    return k < accelerations_.size() ? y_[accelerations_.size() + k]
                                     : accelerations_[k - accelerations_.size()];
  }

  /// The place tau later, or earlier where it is below 0: by the midpoint rule, right up to tau^2.
  [[nodiscard]] std::vector<double> after(double tau);
  /// What each component may be off by then; none where the second order is not small any more.
  [[nodiscard]] std::optional<std::vector<double>> errors_after(double tau);
  /// All states that the motion may have then, by Heun's rule, and what it and Euler's differ by.
  [[nodiscard]] std::optional<std::vector<Interval>> box_after(double tau);
  /// All states and rates that it may have within tau, before and after.
  struct Around {
    std::vector<Interval> y, rates;
  };
  [[nodiscard]] std::optional<Around> around(double tau);

 private:
  [[nodiscard]] std::vector<double> accelerations_at(double t, std::span<const double> y);
  const std::vector<double>& accelerations_off();

  const Dynamics& dynamics_;
  Workspace& workspace_;
  double t_start_, t_;
  std::span<const double> y_;
  std::vector<double> errors_, accelerations_;
  std::vector<double> accelerations_off_;  ///< e_a, once it has been asked for
};

}  // namespace qdot
