#pragma once
// The equations of four systems as one would write them by hand, y' = f(y) for y = (q, q').

#include <array>
#include <cmath>

#include "tests/bench/work_precision/motions.hpp"

namespace qdot::bench {

/// l, theta: m l'' = m l theta'^2 + m g cos(theta) - k (l - l0), l theta'' = -2 l' theta' - g sin(theta)
struct SpringPendulum {
  static constexpr std::size_t dimension = 4;
  double stiffness, l0, g;  ///< k/m

  explicit SpringPendulum(const Problem& p)
      : stiffness(p.parameter("k") / p.parameter("m")), l0(p.parameter("l0")), g(p.parameter("g")) {}

  void operator()(const std::array<double, 4>& y, std::array<double, 4>& f) const {
    const double s = std::sin(y[1]), c = std::cos(y[1]);
    f = {y[2], y[3], y[0] * y[3] * y[3] + g * c - stiffness * (y[0] - l0), -(2 * y[2] * y[3] + g * s) / y[0]};
  }
};

/// theta, phi: a rod and a string of the same length, the same mass each.
struct RodPendulum {
  static constexpr std::size_t dimension = 4;
  double rate2;  ///< g/l

  explicit RodPendulum(const Problem& p) : rate2(p.parameter("g") / p.parameter("l")) {}

  void operator()(const std::array<double, 4>& y, std::array<double, 4>& f) const {
    const double s = std::sin(y[0] - y[1]), c = std::cos(y[0] - y[1]);
    const double a = -y[3] * y[3] * s - 1.5 * rate2 * std::sin(y[0]);
    const double b = y[2] * y[2] * s - rate2 * std::sin(y[1]);
    const double determinant = 4.0 / 3 - c * c;
    f = {y[2], y[3], (a - c * b) / determinant, (4.0 / 3 * b - c * a) / determinant};
  }
};

/// theta'' = sin(theta) (Omega^2 cos(theta) - g/l)
struct WhirlingPendulum {
  static constexpr std::size_t dimension = 2;
  double spin2, rate2;

  explicit WhirlingPendulum(const Problem& p)
      : spin2(p.parameter("Omega") * p.parameter("Omega")), rate2(p.parameter("g") / p.parameter("l")) {}

  void operator()(const std::array<double, 2>& y, std::array<double, 2>& f) const {
    f = {y[1], std::sin(y[0]) * (spin2 * std::cos(y[0]) - rate2)};
  }
};

/// theta, phi, r: the rod feels only the spring at its end, so that nothing has to be solved.
struct RodSpringPendulum {
  static constexpr std::size_t dimension = 6;
  double l, stiffness, l0, g;

  explicit RodSpringPendulum(const Problem& p)
      : l(p.parameter("l")),
        stiffness(p.parameter("k") / p.parameter("m")),
        l0(p.parameter("l0")),
        g(p.parameter("g")) {}

  void operator()(const std::array<double, 6>& y, std::array<double, 6>& f) const {
    const double s = std::sin(y[1] - y[0]), c = std::cos(y[1] - y[0]);
    const double pull = stiffness * (y[2] - l0), w2 = l * y[3] * y[3];
    const double a = (3 * pull * s - 1.5 * g * std::sin(y[0])) / l;
    const double b = -(g * std::sin(y[1]) + l * a * c + w2 * s + 2 * y[5] * y[4]) / y[2];
    f = {y[3], y[4], y[5], a, b, y[2] * y[4] * y[4] + w2 * c - l * a * s - pull + g * std::cos(y[1])};
  }
};

/// Calls `use` with the equations of the problem's system; false where none are written.
template <class Use>
bool with_equations(const Problem& problem, const Use& use) {
  const std::string& system = problem.motion.system;
  if (system == "spring_pendulum") return use(SpringPendulum(problem)), true;
  if (system == "rod_pendulum") return use(RodPendulum(problem)), true;
  if (system == "whirling_pendulum") return use(WhirlingPendulum(problem)), true;
  if (system == "rod_spring_pendulum") return use(RodSpringPendulum(problem)), true;
  return false;
}

}  // namespace qdot::bench
