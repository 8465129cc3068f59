#pragma once
// Random motions of every system: parameters and initial states, drawn over decades.

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "core/numerics/constants.hpp"
#include "tests/calibration/quad_reference.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/random.hpp"

namespace qdot::test {

/// Where the numbers come from: the same seed draws the same ones.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  bool chance(double probability) { return random_.real() < probability; }
  double uniform(double low, double high) { return random_.real(low, high); }
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  double sign() { return chance(0.5) ? 1 : -1; }
  template <class T>
  T one_of(std::initializer_list<T> list) {
    return *(list.begin() + random_.integer(0, static_cast<std::int64_t>(list.size()) - 1));
  }

  /// Around a usual value: near it, or within three decades.
  double parameter(double usual) { return usual * (wild_ ? decades(-3, 3) : decades(-0.5, 0.5)); }
  double gravity() { return chance(0.08) ? 0 : chance(0.5) ? 9.81 : parameter(9.81); }
  void choose_wildness() { wild_ = chance(0.4); }

  double angle() {
    const double kind = uniform(0, 1);
    if (kind < 0.5) return uniform(-pi, pi);
    if (kind < 0.75) return sign() * decades(-6, 0);
    if (kind < 0.85) return sign() * (pi - decades(-8, -1));
    return uniform(-20, 20);
  }
  /// For a motion whose natural rate is w.
  double rate(double w) {
    const double kind = uniform(0, 1);
    if (kind < 0.3) return 0;
    return kind < 0.75 ? w * uniform(-3, 3) : w * sign() * decades(-6, 1);
  }
  double length(double usual) { return usual * (chance(0.7) ? uniform(0.3, 2) : decades(-3, 0.5)); }

 private:
  Random random_;
  bool wild_{};
};

/// Parameters, initial state and the rates that time is measured by.
struct Motion {
  Values given;
  std::vector<double> rates;
  Forcing force{};
};

using Maker = Motion (*)(Draw&);

/// Each system with what draws a motion of it.
[[nodiscard]] const std::vector<std::pair<std::string, Maker>>& motion_makers();

}  // namespace qdot::test
