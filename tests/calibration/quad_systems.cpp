#include "tests/calibration/quad_systems.hpp"

#include <cstdio>

namespace qdot::test {
namespace {

template <typename N>
using P = const PreciseValues<N>&;
template <typename N>
using State = const std::vector<Series<N>>&;
template <typename N>
using Result = std::vector<Series<N>>;

/// All of them: no double has more than 767.
std::string digits(double value) {
  char text[800];
  std::snprintf(text, sizeof text, "(%.767g)", value);
  return text;
}

template <typename N>
Result<N> forced_spring_pendulum(P<N> p, Series<N>, State<N> q, State<N> v, Series<N> F) {
  const N m = p.at("m"), w2 = p.at("k") / m, g = p.at("g");
  const auto [sn, c] = sine_and_cosine(q[1]);
  const Series<N> turn = q[0] * squared(v[1]);
  return {turn + g * c - w2 * (q[0] - p.at("l0")) + (1 / m) * (F * sn),
          ((1 / m) * (F * c) - g * sn - N(2) * (v[0] * v[1])) / q[0]};
}

template <typename N>
Result<N> spring_pendulum(P<N> p, Series<N>, State<N> q, State<N> v, Series<N>) {
  const N w2 = p.at("k") / p.at("m"), g = p.at("g");
  const auto [sn, c] = sine_and_cosine(q[1]);
  return {q[0] * squared(v[1]) + g * c - w2 * (q[0] - p.at("l0")), -(N(2) * (v[0] * v[1]) + g * sn) / q[0]};
}

template <typename N>
Result<N> rolling_disk_platform(P<N> p, Series<N> t, State<N> q, State<N>, Series<N>) {
  const N W = p.at("Omega"), third = N(2) / 3;
  return {third * W * W * q[0] - third * p.at("g") * sin(W * t)};
}

template <typename N>
Result<N> cart_pendulum(P<N> p, Series<N>, State<N> q, State<N> v, Series<N>) {
  const N M = p.at("M"), m = p.at("m"), k = p.at("k"), l = p.at("l"), g = p.at("g");
  const auto [sn, c] = sine_and_cosine(q[1]);
  const Series<N> cart = (m * (sn * (l * squared(v[1]) + g * c)) - k * q[0]) / (M + m * squared(sn));
  return {cart, (-g / l) * sn - (1 / l) * (c * cart)};
}

template <typename N>
Result<N> rod_pendulum(P<N> p, Series<N>, State<N> q, State<N> v, Series<N>) {
  const N G = p.at("g") / p.at("l");
  const auto [sn, c] = sine_and_cosine(q[0] - q[1]);
  const Series<N> bob = squared(v[0]) * sn - G * sin(q[1]);
  const Series<N> rod =
      (-(squared(v[1]) * sn) - N(3) / 2 * G * sin(q[0]) - c * bob) / (N(4) / 3 - squared(c));
  return {rod, bob - c * rod};
}

template <typename N>
Result<N> rod_spring_pendulum(P<N> p, Series<N>, State<N> q, State<N> v, Series<N>) {
  const N m = p.at("m"), l = p.at("l"), k = p.at("k"), l0 = p.at("l0"), g = p.at("g");
  const auto [sn, c] = sine_and_cosine(q[1] - q[0]);
  const auto [sp, cp] = sine_and_cosine(q[1]);
  const Series<N> stretch = q[2] - l0;
  const Series<N> rod = (3 * k / (m * l)) * (stretch * sn) - (3 * g / (2 * l)) * sin(q[0]);
  const Series<N> along = q[2] * squared(v[1]) + l * (squared(v[0]) * c) + g * cp - (k / m) * stretch;
  const Series<N> across = -(N(2) * (v[2] * v[1])) - l * (squared(v[0]) * sn) - g * sp;
  return {rod, (across - l * (c * rod)) / q[2], along - l * (sn * rod)};
}

template <typename N>
Result<N> whirling_pendulum(P<N> p, Series<N>, State<N> q, State<N>, Series<N>) {
  const N W = p.at("Omega");
  const auto [sn, c] = sine_and_cosine(q[0]);
  return {sn * (W * W * c - p.at("g") / p.at("l"))};
}

template <typename N>
Result<N> orbiting_pendulum(P<N> p, Series<N>, State<N> q, State<N>, Series<N>) {
  const N w = p.at("omega0");
  return {(-p.at("r") / p.at("l") * w * w) * sin(q[0])};
}

template <typename N>
Result<N> free_spin_pendulum(P<N> p, Series<N>, State<N> q, State<N> v, Series<N>) {
  const auto [sn, c] = sine_and_cosine(q[0]);
  const Series<N> arm = N(0.5) + sn;
  return {squared(v[1]) * (arm * c) - (p.at("g") / p.at("l")) * sn, -(N(2) * (v[0] * (v[1] * c))) / arm};
}

template <typename N>
Result<N> compass_walker(P<N> p, Series<N>, State<N> q, State<N> v, Series<N>) {
  const N mu = p.at("m") / p.at("M"), G = p.at("g") / p.at("l"), gamma = p.at("gamma");
  const auto [sn, c] = sine_and_cosine(q[1]);
  const Series<N> hip = sin(q[0] - gamma), foot = sin(q[0] - q[1] - gamma);
  const Series<N> spin = squared(v[0]);
  const Series<N> push = (N(1) - c) * spin + squared(v[1]) - N(2) * (v[0] * v[1]);
  const Series<N> stance =
      (G * (1 + mu) * hip - (G * mu) * (c * foot) + mu * (sn * push)) / (N(1) + mu * squared(sn));
  return {stance, sn * spin + G * foot + (N(1) - c) * stance};
}

template <typename N>
Result<N> rotating_l_bar(P<N> p, Series<N>, State<N> q, State<N>, Series<N>) {
  const N W2 = p.at("Omega") * p.at("Omega"), G = p.at("g") / p.at("l");
  const auto [sn, c] = sine_and_cosine(q[0]);
  const Series<N> spin = N(53) / 3 * (sn * c) + N(1.5) * (squared(sn) - squared(c));
  return {N(3) / 55 * (W2 * spin - N(7.5) * G * sn + N(0.5) * G * c)};
}

template <typename N>
Result<N> plane_pendulum(P<N> p, Series<N>, State<N> q, State<N>, Series<N>) {
  return {(-p.at("g") / p.at("l")) * sin(q[0])};
}

template <typename N>
Result<N> driven_pivot(P<N> p, Series<N> t, State<N> q, State<N>, Series<N>) {
  const N w = p.at("w"), l = p.at("l");
  return {sin(q[0]) * ((p.at("a") / l * w * w) * cos(w * t) - p.at("g") / l)};
}

template <typename N>
Result<N> damped_oscillator(P<N> p, Series<N>, State<N> q, State<N> v, Series<N> F) {
  const N m = p.at("m");
  return {(1 / m) * F - (p.at("b") / m) * v[0] - (p.at("k") / m) * q[0]};
}

template <typename N>
Result<N> damped_pendulum(P<N> p, Series<N>, State<N> q, State<N> v, Series<N>) {
  const N m = p.at("m"), l = p.at("l");
  return {(-p.at("g") / l) * sin(q[0]) - (p.at("b") / (m * l * l)) * v[0]};
}

template <typename N>
const std::map<std::string, Accelerations<N>>& table() {
  static const std::map<std::string, Accelerations<N>> systems{
      {"spring_pendulum", spring_pendulum<N>},
      {"forced_spring_pendulum", forced_spring_pendulum<N>},
      {"rolling_disk_platform", rolling_disk_platform<N>},
      {"cart_pendulum", cart_pendulum<N>},
      {"rod_pendulum", rod_pendulum<N>},
      {"rod_spring_pendulum", rod_spring_pendulum<N>},
      {"whirling_pendulum", whirling_pendulum<N>},
      {"orbiting_pendulum", orbiting_pendulum<N>},
      {"free_spin_pendulum", free_spin_pendulum<N>},
      {"compass_walker", compass_walker<N>},
      {"rotating_l_bar", rotating_l_bar<N>},
      {"plane_pendulum", plane_pendulum<N>},
      {"driven_pivot", driven_pivot<N>},
      {"damped_oscillator", damped_oscillator<N>},
      {"damped_pendulum", damped_pendulum<N>},
  };
  return systems;
}

}  // namespace

std::string Forcing::text() const {
  const std::string wave = digits(amplitude) + "*exp(-" + digits(decay) + "*t)*cos(" + digits(frequency) +
                           "*t + " + digits(phase) + ")";
  return rectified ? "abs(" + wave + ")" : wave;
}

template <typename Number>
const Accelerations<Number>& precise_accelerations(const std::string& system) {
  return table<Number>().at(system);
}
template const Accelerations<Quad>& precise_accelerations(const std::string& system);
template const Accelerations<Long>& precise_accelerations(const std::string& system);

std::vector<std::string> quad_systems() {
  std::vector<std::string> names;
  for (const auto& [name, equations] : table<Quad>()) names.push_back(name);
  return names;
}

}  // namespace qdot::test
