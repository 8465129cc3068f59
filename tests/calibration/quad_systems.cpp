#include "tests/calibration/quad_systems.hpp"

#include <cstdio>

namespace qdot::test {
namespace {

using P = const QuadValues&;
using S = Series;
using State = const std::vector<Series>&;
using Result = std::vector<Series>;

/// All of them: no double has more than 767.
std::string digits(double value) {
  char text[800];
  std::snprintf(text, sizeof text, "(%.767g)", value);
  return text;
}

Result forced_spring_pendulum(P p, S, State q, State v, S F) {
  const Quad m = p.at("m"), w2 = p.at("k") / m, g = p.at("g");
  const auto [sn, c] = sine_and_cosine(q[1]);
  const S turn = q[0] * squared(v[1]);
  return {turn + g * c - w2 * (q[0] - p.at("l0")) + (1 / m) * (F * sn),
          ((1 / m) * (F * c) - g * sn - Quad(2) * (v[0] * v[1])) / q[0]};
}

Result spring_pendulum(P p, S, State q, State v, S) {
  const Quad w2 = p.at("k") / p.at("m"), g = p.at("g");
  const auto [sn, c] = sine_and_cosine(q[1]);
  return {q[0] * squared(v[1]) + g * c - w2 * (q[0] - p.at("l0")),
          -(Quad(2) * (v[0] * v[1]) + g * sn) / q[0]};
}

Result rolling_disk_platform(P p, S t, State q, State, S) {
  const Quad W = p.at("Omega"), third = Quad(2) / 3;
  return {third * W * W * q[0] - third * p.at("g") * sin(W * t)};
}

Result cart_pendulum(P p, S, State q, State v, S) {
  const Quad M = p.at("M"), m = p.at("m"), k = p.at("k"), l = p.at("l"), g = p.at("g");
  const auto [sn, c] = sine_and_cosine(q[1]);
  const S cart = (m * (sn * (l * squared(v[1]) + g * c)) - k * q[0]) / (M + m * squared(sn));
  return {cart, (-g / l) * sn - (1 / l) * (c * cart)};
}

Result rod_pendulum(P p, S, State q, State v, S) {
  const Quad G = p.at("g") / p.at("l");
  const auto [sn, c] = sine_and_cosine(q[0] - q[1]);
  const S bob = squared(v[0]) * sn - G * sin(q[1]);
  const S rod = (-(squared(v[1]) * sn) - Quad(3) / 2 * G * sin(q[0]) - c * bob) / (Quad(4) / 3 - squared(c));
  return {rod, bob - c * rod};
}

Result rod_spring_pendulum(P p, S, State q, State v, S) {
  const Quad m = p.at("m"), l = p.at("l"), k = p.at("k"), l0 = p.at("l0"), g = p.at("g");
  const auto [sn, c] = sine_and_cosine(q[1] - q[0]);
  const auto [sp, cp] = sine_and_cosine(q[1]);
  const S stretch = q[2] - l0;
  const S rod = (3 * k / (m * l)) * (stretch * sn) - (3 * g / (2 * l)) * sin(q[0]);
  const S along = q[2] * squared(v[1]) + l * (squared(v[0]) * c) + g * cp - (k / m) * stretch;
  const S across = -(Quad(2) * (v[2] * v[1])) - l * (squared(v[0]) * sn) - g * sp;
  return {rod, (across - l * (c * rod)) / q[2], along - l * (sn * rod)};
}

Result whirling_pendulum(P p, S, State q, State, S) {
  const Quad W = p.at("Omega");
  const auto [sn, c] = sine_and_cosine(q[0]);
  return {sn * (W * W * c - p.at("g") / p.at("l"))};
}

Result orbiting_pendulum(P p, S, State q, State, S) {
  const Quad w = p.at("omega0");
  return {(-p.at("r") / p.at("l") * w * w) * sin(q[0])};
}

Result free_spin_pendulum(P p, S, State q, State v, S) {
  const auto [sn, c] = sine_and_cosine(q[0]);
  const S arm = Quad(0.5) + sn;
  return {squared(v[1]) * (arm * c) - (p.at("g") / p.at("l")) * sn, -(Quad(2) * (v[0] * (v[1] * c))) / arm};
}

Result compass_walker(P p, S, State q, State v, S) {
  const Quad mu = p.at("m") / p.at("M"), G = p.at("g") / p.at("l"), gamma = p.at("gamma");
  const auto [sn, c] = sine_and_cosine(q[1]);
  const S hip = sin(q[0] - gamma), foot = sin(q[0] - q[1] - gamma);
  const S spin = squared(v[0]);
  const S push = (Quad(1) - c) * spin + squared(v[1]) - Quad(2) * (v[0] * v[1]);
  const S stance =
      (G * (1 + mu) * hip - (G * mu) * (c * foot) + mu * (sn * push)) / (Quad(1) + mu * squared(sn));
  return {stance, sn * spin + G * foot + (Quad(1) - c) * stance};
}

Result rotating_l_bar(P p, S, State q, State, S) {
  const Quad W2 = p.at("Omega") * p.at("Omega"), G = p.at("g") / p.at("l");
  const auto [sn, c] = sine_and_cosine(q[0]);
  const S spin = Quad(53) / 3 * (sn * c) + Quad(1.5) * (squared(sn) - squared(c));
  return {Quad(3) / 55 * (W2 * spin - Quad(7.5) * G * sn + Quad(0.5) * G * c)};
}

Result plane_pendulum(P p, S, State q, State, S) { return {(-p.at("g") / p.at("l")) * sin(q[0])}; }

Result driven_pivot(P p, S t, State q, State, S) {
  const Quad w = p.at("w"), l = p.at("l");
  return {sin(q[0]) * ((p.at("a") / l * w * w) * cos(w * t) - p.at("g") / l)};
}

Result damped_oscillator(P p, S, State q, State v, S F) {
  const Quad m = p.at("m");
  return {(1 / m) * F - (p.at("b") / m) * v[0] - (p.at("k") / m) * q[0]};
}

Result damped_pendulum(P p, S, State q, State v, S) {
  const Quad m = p.at("m"), l = p.at("l");
  return {(-p.at("g") / l) * sin(q[0]) - (p.at("b") / (m * l * l)) * v[0]};
}

const std::map<std::string, Accelerations>& table() {
  static const std::map<std::string, Accelerations> systems{
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
      {"damped_oscillator", damped_oscillator},
      {"damped_pendulum", damped_pendulum},
  };
  return systems;
}

}  // namespace

std::string Forcing::text() const {
  const std::string wave = digits(amplitude) + "*exp(-" + digits(decay) + "*t)*cos(" + digits(frequency) +
                           "*t + " + digits(phase) + ")";
  return rectified ? "abs(" + wave + ")" : wave;
}

const Accelerations& quad_accelerations(const std::string& system) { return table().at(system); }

std::vector<std::string> quad_systems() {
  std::vector<std::string> names;
  for (const auto& [name, equations] : table()) names.push_back(name);
  return names;
}

}  // namespace qdot::test
