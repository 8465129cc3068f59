#include "core/numerics/root.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

constexpr int most_scales = 8;  ///< a place may be far smaller than its bracket's ends

// One ITP iteration for a bracket of width w = b - a, the letters as in the paper: interpolate, truncate
// towards the middle, project into the radius r around the middle
// that keeps the count of evaluations bounded.
double itp_point(const SignChange& bracket, double k1, double r, double tolerance) {
  const double a = bracket.before;
  const double w = bracket.after - a;
  const double half = a + 0.5 * w;
  const double regula_falsi = a - bracket.value_before * (w / (bracket.value_after - bracket.value_before));
  const double sigma = regula_falsi <= half ? 1 : -1;
  const double delta = std::max(k1 * w * w, tolerance);
  const double truncated = delta <= std::abs(half - regula_falsi) ? regula_falsi + sigma * delta : half;
  const double projected = std::abs(truncated - half) <= r ? truncated : half - sigma * r;
  return projected > a && projected < bracket.after ? projected : half;
}

double round_off_of(const SignChange& bracket) {
  return std::max(time_round_off(std::max(std::abs(bracket.before), std::abs(bracket.after))) / 2,
                  std::numeric_limits<double>::min());
}

bool is_narrow(const SignChange& bracket, double tolerance) {
  return bracket.after - bracket.before <= tolerance || bracket.value_after == 0;
}

/// To the tolerance, or to neighbouring numbers.
SignChange narrowed(const std::function<double(double)>& function, SignChange bracket, double tolerance) {
  const bool rising = bracket.value_after > 0;
  const double width = bracket.after - bracket.before;
  const double k1 = 0.2 / width;
  const int most = std::ilogb(std::max(1.0, width / tolerance)) + 2;
  for (int j = 0; j <= most && !is_narrow(bracket, tolerance); ++j) {
    const double r = std::ldexp(tolerance, most - 1 - j) - 0.5 * (bracket.after - bracket.before);
    const double t = itp_point(bracket, k1, std::max(r, 0.0), tolerance);
    if (!(t > bracket.before && t < bracket.after)) break;  // neighbouring numbers
    const double value = function(t);
    const bool passed = rising ? value >= 0 : value <= 0;
    if (passed) {
      bracket.after = t;
      bracket.value_after = value;
    } else {
      bracket.before = t;
      // NaN must not enter the interpolation; a value of the old sign keeps the bracket.
      if (!std::isnan(value)) bracket.value_before = value;
    }
  }
  return bracket;
}

}  // namespace

double time_round_off(double t) { return 4 * std::numeric_limits<double>::epsilon() * std::abs(t); }

SignChange find_sign_change(const std::function<double(double)>& function, SignChange bracket) {
  for (int i = 0; i < most_scales; ++i) {
    const double tolerance = round_off_of(bracket);
    bracket = narrowed(function, bracket, tolerance);
    if (is_narrow(bracket, round_off_of(bracket))) break;
  }
  return bracket;
}

}  // namespace qdot
