#pragma once
// Steps whose polynomials are known to obey the equation over all their length: RightHandSide::defect bounds
// the defect d_i of a step of length h, and the step is short enough where
//
//   h d_i <= 100 w_i        (a reference: 10 w_i, and 4 w_i as long as that holds steps short)
//
// Where h d_i is more than 50 times the last three terms of the series, these terms give no sign of it. A
// reference then adds h d_i to its unseen error, in the unit of y_i; that of velocities is carried on to the
// coordinates.

#include <cstddef>
#include <span>
#include <vector>

#include "core/integrate/run.hpp"

namespace qdot {

/// Of h d_i what the largest of the last three terms does not show: nothing, or all.
[[nodiscard]] inline double hidden_behind(double last_term, double bound) {
  constexpr double visible = 50;
  return bound > visible * last_term ? bound : 0;
}
/// The same for each component of a series. Returns whether anything is hidden.
bool find_hidden(double h, std::span<const double> series, unsigned order, std::span<const double> defect,
                 std::span<double> hidden);

class BoundedSteps {
 public:
  /// n components, series of the given order.
  BoundedSteps(const RightHandSide& system, const RunRequest& request, std::size_t n, unsigned order);

  /// Of series from the next on; before a first step.
  void take_order(unsigned order) { order_ = order; }

  struct Bound {
    double h{};
    bool found{};
  };

  /// A step from t up to h whose defect is bounded by what is allowed; h itself where there is none.
  /// `series`: what was expanded last; `weights`: w_i. Where the last step had to be a little shorter than
  /// wanted, this one is tried shortened as much.
  [[nodiscard]] Bound find(double t, double h, std::span<const double> series,
                           std::span<const double> weights);

  /// Adds what the step found last may hide to what has gone unseen.
  void add_unseen(double h, std::span<const double> series);
  /// Bounds the last step again as one of length h, where it has ended: the bound of the whole step may be
  /// ten thousand times as large. Its series has been expanded again.
  void shorten(double h, std::span<const double> series);

  [[nodiscard]] std::span<const double> defect() const { return defect_; }
  [[nodiscard]] std::span<const double> rounding() const { return rounding_; }  ///< of accelerations
  [[nodiscard]] std::span<const double> unseen() const { return unseen_; }

 private:
  void allow(bool is_held, std::span<const double> weights);
  [[nodiscard]] double excess(double h) { return system_.defect(h, allowed_, defect_); }
  void bound_closely(double h) { (void)system_.defect(h, {}, defect_); }
  [[nodiscard]] double lengthened(double good, double bad);
  void look_closely(double h, std::span<const double> series);
  /// hidden_. Whether there is any.
  bool find_hidden(double h, std::span<const double> series) {
    return qdot::find_hidden(h, series, order_, defect_, hidden_);
  }

  const RightHandSide& system_;
  const RunRequest& request_;
  unsigned order_;
  std::vector<double> allowed_, defect_, hidden_;
  std::vector<double> rounding_;
  std::vector<double> hidden_so_far_, off_so_far_, unseen_;
  std::vector<double> hidden_before_, off_before_;  ///< the last step
  bool hides_{false};                               ///< the step that was just bounded
  double share_{1};                                 ///< of the length wanted, to begin with
};

}  // namespace qdot
