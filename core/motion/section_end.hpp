#pragma once
// An impact or a kink, where one section of a motion ends and the next one begins.

#include <functional>
#include <span>
#include <vector>

namespace qdot {

/// The event g = 0 at t, and the states y = (q, q') and slopes y' on both sides of it.
struct SectionEnd {
  double t{};
  std::vector<double> before, slopes_before, after, slopes_after;
  double doubt{};                 ///< by how many seconds rounding may have moved the instant
  double moved{};                 ///< by how many it has moved it, which is taken back in the state after it
  double rounding{};              ///< what g may be rounded by there
  std::vector<double> reached{};  ///< the largest |y_i| up to there
  std::function<double(double t, std::span<const double> y)> g;
  /// The state after it by that before it, at an instant near t; as it is, where there is no such function.
  std::function<std::vector<double>(double t, const std::vector<double>& y)> map{};
};

}  // namespace qdot
