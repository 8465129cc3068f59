#include "tests/calibration/random_motion.hpp"

#include <algorithm>

namespace qdot::test {
namespace {

/// A stretched spring's equilibrium length.
double hanging(double m, double k, double l0, double g) {
  const double length = l0 + (k > 0 ? m * g / k : 1);
  return length > 0 ? length : 1;
}

Motion spring_pendulum(Draw& draw) {
  const double m = draw.parameter(0.5), k = draw.chance(0.03) ? 0 : draw.parameter(40);
  const double l0 = draw.chance(0.06) ? 0 : draw.parameter(0.4), g = draw.gravity();
  const double size = hanging(m, k, l0, g), w = std::sqrt(k / m), swing = std::sqrt(g / size);
  const double unit = std::max({w, swing, 1e-3});
  const double l = draw.length(size), turn = draw.rate(unit);
  return {{{"m", m},
           {"k", k},
           {"l0", l0},
           {"g", g},
           {"l", l},
           {"theta", draw.angle()},
           {"l_dot", size * draw.rate(unit)},
           {"theta_dot", turn}},
          {w, swing, std::abs(turn), std::sqrt(g / l)}};
}

Motion forced_spring_pendulum(Draw& draw) {
  Motion motion = spring_pendulum(draw);
  const double w = std::max({motion.rates[0], motion.rates[1], 1e-3});
  Forcing& f = motion.force;
  f.amplitude = draw.sign() * motion.given["m"] * std::max(motion.given["g"], 0.1) * draw.decades(-2, 0.5);
  f.frequency = draw.chance(0.3) ? w : w * draw.decades(-2, 1.5);
  if (draw.chance(0.2)) f.decay = w * draw.decades(-3, -1);
  if (draw.chance(0.6)) f.phase = draw.uniform(-3, 3);
  f.rectified = draw.chance(0.15);
  motion.rates.push_back(f.frequency);
  return motion;
}

Motion rolling_disk_platform(Draw& draw) {
  const double W = draw.chance(0.05) ? 0 : draw.sign() * draw.parameter(0.5);
  const double r = draw.parameter(0.05), g = draw.gravity();
  return {{{"m", draw.parameter(0.2)},
           {"r", r},
           {"Omega", W},
           {"g", g},
           {"q", draw.chance(0.3) ? 0 : draw.sign() * draw.parameter(0.5)},
           {"q_dot", draw.rate(1)}},
          {10 * std::abs(W)}};  // it grows as exp(W t)
}

Motion cart_pendulum(Draw& draw) {
  const double M = draw.parameter(1), m = draw.parameter(0.5), k = draw.chance(0.05) ? 0 : draw.parameter(25);
  const double l = draw.parameter(0.4), g = draw.gravity();
  const double cart = std::sqrt(k / M), swing = std::sqrt(g / l * (M + m) / M),
               w = std::max({cart, swing, 1e-3});
  return {{{"M", M},
           {"m", m},
           {"k", k},
           {"l", l},
           {"g", g},
           {"x", draw.sign() * draw.length(l)},
           {"theta", draw.angle()},
           {"x_dot", l * draw.rate(w)},
           {"theta_dot", draw.rate(w)}},
          {cart, swing, w}};
}

Motion rod_pendulum(Draw& draw) {
  const double l = draw.parameter(0.5), g = draw.gravity(), w = std::max(std::sqrt(g / l), 1e-3);
  return {{{"m", draw.parameter(0.5)},
           {"l", l},
           {"g", g},
           {"theta", draw.angle()},
           {"phi", draw.angle()},
           {"theta_dot", draw.rate(w)},
           {"phi_dot", draw.rate(w)}},
          {2.8 * w}};
}

Motion rod_spring_pendulum(Draw& draw) {
  const double m = draw.parameter(0.5), l = draw.parameter(0.5), k = draw.parameter(40),
               l0 = draw.parameter(0.4);
  const double g = draw.gravity(), size = hanging(m, k, l0, g), w = std::sqrt(k / m),
               swing = std::sqrt(g / l);
  const double unit = std::max(w, swing), r = draw.length(size);
  return {{{"m", m},
           {"l", l},
           {"k", k},
           {"l0", l0},
           {"g", g},
           {"theta", draw.angle()},
           {"phi", draw.angle()},
           {"r", r},
           {"theta_dot", draw.rate(swing)},
           {"phi_dot", draw.rate(unit)},
           {"r_dot", size * draw.rate(unit)}},
          {2 * w, swing, std::sqrt(g / r)}};
}

Motion whirling_pendulum(Draw& draw) {
  const double l = draw.parameter(0.5), g = draw.gravity(), swing = std::max(std::sqrt(g / l), 1e-3);
  const double critical = swing * (1 + draw.sign() * draw.decades(-9, -2));
  const double W = draw.sign() * (draw.chance(0.2) ? critical : swing * draw.decades(-1.5, 1.5));
  return {{{"m", draw.parameter(0.2)},
           {"l", l},
           {"R", draw.parameter(0.3)},
           {"Omega", W},
           {"g", g},
           {"theta", draw.angle()},
           {"theta_dot", draw.rate(std::max(swing, std::abs(W)))}},
          {swing, std::abs(W)}};
}

Motion orbiting_pendulum(Draw& draw) {
  const double l = draw.parameter(0.5), r = draw.chance(0.2) ? l : draw.parameter(0.5);
  const double W = draw.sign() * draw.parameter(2), w = std::abs(W) * std::sqrt(r / l);
  return {{{"m", draw.parameter(0.2)},
           {"l", l},
           {"r", r},
           {"omega0", W},
           {"phi", draw.angle()},
           {"phi_dot", draw.chance(0.3) ? W : draw.rate(w)}},
          {w, std::abs(W)}};
}

Motion free_spin_pendulum(Draw& draw) {
  const double l = draw.parameter(0.5), g = draw.gravity(), w = std::max(std::sqrt(g / l), 1e-3);
  const double spin = draw.chance(0.3) ? 2 * w : draw.rate(w);
  return {{{"m", draw.parameter(0.2)},
           {"l", l},
           {"g", g},
           {"theta", draw.angle()},
           {"psi", draw.angle()},
           {"theta_dot", draw.rate(w)},
           {"psi_dot", spin}},
          {w, std::abs(spin)}};
}

Motion compass_walker(Draw& draw) {
  const double M = draw.parameter(1), m = draw.chance(0.4) ? 0 : M * draw.decades(-4, 0);
  const double l = draw.parameter(1), g = 9.81 * draw.decades(-1, 1), w = std::sqrt(g / l);
  const double spread = draw.decades(-4, -0.5);
  const auto near = [&](double value) { return value * (1 + spread * draw.uniform(-1, 1)); };
  return {{{"M", M},
           {"m", m},
           {"l", l},
           {"g", g},
           {"gamma", 0.009 * draw.uniform(0.2, 1.6)},
           {"theta", near(0.2003)},
           {"phi", near(0.4006)},
           {"theta_dot", near(-0.1998) * w},
           {"phi_dot", near(-0.01582) * w}},
          {3 * w}};
}

Motion rotating_l_bar(Draw& draw) {
  const double l = draw.parameter(0.2), g = draw.gravity(), w = std::max(std::sqrt(g / l / 2), 1e-3);
  const double W = draw.sign() * w * draw.decades(-1.5, 1.5);
  return {{{"m", draw.parameter(0.2)},
           {"l", l},
           {"Omega", W},
           {"g", g},
           {"theta", draw.angle()},
           {"theta_dot", draw.rate(std::max(w, std::abs(W)))}},
          {w, std::abs(W)}};
}

Motion plane_pendulum(Draw& draw) {
  const double l = draw.parameter(1), g = draw.parameter(9.81), w = std::sqrt(g / l);
  const bool at_the_top = draw.chance(0.3);
  return {{{"m", 1},
           {"l", l},
           {"g", g},
           {"theta", at_the_top ? pi - draw.decades(-12, -3) : draw.angle()},
           {"theta_dot", at_the_top         ? 0
                         : draw.chance(0.2) ? 2 * w * (1 - draw.decades(-12, -3))
                                            : draw.rate(w)}},
          {w}};
}

Motion driven_pivot(Draw& draw) {
  const double l = draw.parameter(1), g = draw.gravity(), w = std::max(std::sqrt(g / l), 1e-3);
  const double drive = draw.chance(0.3) ? 2 * w : w * draw.decades(-1, 1.7);
  return {{{"m", 1},
           {"l", l},
           {"g", g},
           {"a", l * draw.decades(-3, 0)},
           {"w", drive},
           {"theta", draw.angle()},
           {"theta_dot", draw.rate(w)}},
          {w, drive}};
}

Motion damped_oscillator(Draw& draw) {
  const double m = draw.parameter(0.5), k = draw.parameter(8), w = std::sqrt(k / m);
  const double b = 2 * std::sqrt(m * k) * (draw.chance(0.1) ? 1 : draw.decades(-3, 2));
  Motion motion{{{"m", m}, {"b", b}, {"k", k}, {"x", draw.parameter(0.2)}, {"x_dot", draw.rate(w)}},
                {w, b / m}};
  if (draw.chance(0.6)) {
    motion.force = {k * draw.decades(-2, 0), 0, draw.chance(0.3) ? w : w * draw.decades(-1, 1.5), 0.3,
                    draw.chance(0.15)};
    motion.rates.push_back(motion.force.frequency);
  }
  return motion;
}

}  // namespace

const std::vector<std::pair<std::string, Maker>>& motion_makers() {
  static const std::vector<std::pair<std::string, Maker>> makers{
      {"spring_pendulum", spring_pendulum},
      {"forced_spring_pendulum", forced_spring_pendulum},
      {"rolling_disk_platform", rolling_disk_platform},
      {"cart_pendulum", cart_pendulum},
      {"rod_pendulum", rod_pendulum},
      {"rod_spring_pendulum", rod_spring_pendulum},
      {"whirling_pendulum", whirling_pendulum},
      {"orbiting_pendulum", orbiting_pendulum},
      {"free_spin_pendulum", free_spin_pendulum},
      {"compass_walker", compass_walker},
      {"rotating_l_bar", rotating_l_bar},
      {"plane_pendulum", plane_pendulum},
      {"driven_pivot", driven_pivot},
      {"damped_oscillator", damped_oscillator}};
  return makers;
}

}  // namespace qdot::test
