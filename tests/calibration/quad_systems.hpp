#pragma once
// The equations of motion of the practice problems, and of some textbook systems, solved for the
// accelerations and written by hand on Series: the sheet's, corrected as in hand_written.hpp.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/calibration/quad_series.hpp"

namespace qdot::test {

template <typename Number>
using PreciseValues = std::map<std::string, Number>;

/// A exp(-b t) cos(w t + p), or its absolute value; what a scene's input is.
struct Forcing {
  double amplitude{}, decay{}, frequency{}, phase{};
  bool rectified{};  ///< |...|: a kink at every zero

  /// As an expression for the program, every number with all of its digits: the program takes a literal for
  /// the decimal that it is.
  [[nodiscard]] std::string text() const;
};

/// q'' from t, q, q'; `force` is the scene's input, where it has one.
template <typename Number>
using Accelerations = std::function<std::vector<Series<Number>>(
    const PreciseValues<Number>& parameters, Series<Number> t, const std::vector<Series<Number>>& q,
    const std::vector<Series<Number>>& v, Series<Number> force)>;

/// Throws std::out_of_range for a system that is not written here.
template <typename Number>
[[nodiscard]] const Accelerations<Number>& precise_accelerations(const std::string& system);
[[nodiscard]] std::vector<std::string> quad_systems();

}  // namespace qdot::test
