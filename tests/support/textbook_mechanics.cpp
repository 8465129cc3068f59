#include "tests/support/textbook_mechanics.hpp"

#include <algorithm>

namespace qdot::test {
namespace {

using std::cos;
using std::sin;

constexpr double squared(double x) { return x * x; }

}  // namespace

Mechanics plane_pendulum(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), g = s.at("g"), ml2 = m * l * l;
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot");
  Mechanics x;
  x.kinetic = {ml2 * th1 * th1 / 2};
  x.potential = {-m * g * l * cos(th)};
  x.equations = {{ml2 * th2, m * g * l * sin(th)}};
  x.accelerations = {{-g / l * sin(th)}};
  x.momenta = {{ml2 * th1}};
  x.jacobi = {ml2 * th1 * th1 / 2, -m * g * l * cos(th)};
  return x;
}

Mechanics spherical_pendulum(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), g = s.at("g"), ml2 = m * l * l;
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot");
  const double ph1 = s.at("phi_dot"), ph2 = s.at("phi_ddot"), sn = sin(th), c = cos(th);
  Mechanics x;
  x.kinetic = {ml2 * th1 * th1 / 2, ml2 * sn * sn * ph1 * ph1 / 2};
  x.potential = {-m * g * l * c};
  x.equations = {{ml2 * th2, -ml2 * sn * c * ph1 * ph1, m * g * l * sn},
                 {ml2 * sn * sn * ph2, 2 * ml2 * sn * c * th1 * ph1}};
  x.accelerations = {{sn * c * ph1 * ph1, -g / l * sn}, {-2 * c / sn * th1 * ph1}};
  x.momenta = {{ml2 * th1}, {ml2 * sn * sn * ph1}};
  x.jacobi = {ml2 * th1 * th1 / 2, ml2 * sn * sn * ph1 * ph1 / 2, -m * g * l * c};
  x.determinant = squared(ml2 * sn);
  return x;
}

Mechanics kepler(const Values& s) {
  const double m = s.at("m"), mu = s.at("mu"), r = s.at("r"), r1 = s.at("r_dot"), r2 = s.at("r_ddot");
  const double th1 = s.at("theta_dot"), th2 = s.at("theta_ddot");
  Mechanics x;
  x.kinetic = {m * r1 * r1 / 2, m * r * r * th1 * th1 / 2};
  x.potential = {-m * mu / r};
  x.equations = {{m * r2, -m * r * th1 * th1, m * mu / (r * r)}, {m * r * r * th2, 2 * m * r * r1 * th1}};
  x.accelerations = {{r * th1 * th1, -mu / (r * r)}, {-2 * r1 * th1 / r}};
  x.momenta = {{m * r1}, {m * r * r * th1}};
  x.jacobi = {m * r1 * r1 / 2, m * r * r * th1 * th1 / 2, -m * mu / r};
  x.determinant = m * m * r * r;
  return x;
}

Mechanics driven_pivot(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), a = s.at("a"), w = s.at("w"), g = s.at("g"), wt = w * s.at("t");
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot"), ml2 = m * l * l;
  Mechanics x;
  x.kinetic = {ml2 * th1 * th1 / 2, -m * l * a * w * sin(wt) * sin(th) * th1,
               m * squared(a * w * sin(wt)) / 2};
  x.potential = {m * g * a * cos(wt), -m * g * l * cos(th)};
  x.equations = {{ml2 * th2, -m * l * a * w * w * cos(wt) * sin(th), m * g * l * sin(th)}};
  x.accelerations = {{-g / l * sin(th), a / l * w * w * cos(wt) * sin(th)}};
  x.momenta = {{ml2 * th1, -m * l * a * w * sin(wt) * sin(th)}};
  x.jacobi = {ml2 * th1 * th1 / 2, -m * squared(a * w * sin(wt)) / 2, m * g * a * cos(wt),
              -m * g * l * cos(th)};
  return x;
}

Mechanics atwood(const Values& s) {
  const double m1 = s.at("m1"), m2 = s.at("m2"), l = s.at("l"), g = s.at("g"), d = s.at("x");
  const double d1 = s.at("x_dot"), d2 = s.at("x_ddot");
  Mechanics x;
  x.kinetic = {(m1 + m2) * d1 * d1 / 2};
  x.potential = {-m1 * g * d, m2 * g * d, -m2 * g * l};
  x.equations = {{(m1 + m2) * d2, -m1 * g, m2 * g}};
  x.accelerations = {1 / (m1 + m2) * Terms{m1 * g, -m2 * g}};
  x.momenta = {{(m1 + m2) * d1}};
  x.jacobi = *x.kinetic + *x.potential;
  return x;
}

Mechanics bead_on_hoop(const Values& s) {
  const double m = s.at("m"), r = s.at("r"), W = s.at("Omega"), g = s.at("g"), mr2 = m * r * r;
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot");
  Mechanics x;
  x.kinetic = {mr2 * th1 * th1 / 2, mr2 * squared(W * sin(th)) / 2};
  x.potential = {-m * g * r * cos(th)};
  x.equations = {{mr2 * th2, -mr2 * W * W * sin(th) * cos(th), m * g * r * sin(th)}};
  x.accelerations = {{sin(th) * W * W * cos(th), -sin(th) * g / r}};
  x.momenta = {{mr2 * th1}};
  x.jacobi = {mr2 * th1 * th1 / 2, -mr2 * squared(W * sin(th)) / 2, -m * g * r * cos(th)};
  return x;
}

Mechanics foucault(const Values& s) {
  const double m = s.at("m"), G = s.at("g") / s.at("l"), wz = s.at("Omega") * sin(s.at("latitude"));
  const double px = s.at("x"), py = s.at("y"), x1 = s.at("x_dot"), y1 = s.at("y_dot");
  const double x2 = s.at("x_ddot"), y2 = s.at("y_ddot");
  Mechanics x;
  x.equations = {{m * x2, m * G * px, -2 * m * wz * y1}, {m * y2, m * G * py, 2 * m * wz * x1}};
  x.accelerations = {{-G * px, 2 * wz * y1}, {-G * py, -2 * wz * x1}};
  x.momenta = {{m * x1, -m * wz * py}, {m * y1, m * wz * px}};
  x.jacobi = {m * x1 * x1 / 2, m * y1 * y1 / 2, m * G * px * px / 2, m * G * py * py / 2};
  x.determinant = m * m;
  return x;
}

Mechanics triple_pendulum(const Values& s) {
  const double ml2 = s.at("m") * squared(s.at("l")), G = s.at("g") / s.at("l");
  std::array<double, 3> q{}, q1{}, q2{};
  for (std::size_t j = 0; j < 3; ++j) {
    const std::string name = "q" + std::to_string(j + 1);
    q[j] = s.at(name);
    q1[j] = s.at(name + "_dot");
    q2[j] = s.at(name + "_ddot");
  }
  const auto a = [&](std::size_t j, std::size_t k) { return ml2 * static_cast<double>(3 - std::max(j, k)); };
  Mechanics x;
  x.kinetic = x.potential = Terms{};
  for (std::size_t j = 0; j < 3; ++j) {
    Terms equation, momentum;
    *x.potential = *x.potential + Terms{-a(j, j) * G * cos(q[j])};
    equation = equation + Terms{a(j, j) * G * sin(q[j])};
    for (std::size_t k = 0; k < 3; ++k) {
      *x.kinetic = *x.kinetic + Terms{a(j, k) * cos(q[j] - q[k]) * q1[j] * q1[k] / 2};
      equation = equation + Terms{a(j, k) * cos(q[j] - q[k]) * q2[k]};
      equation = equation + Terms{a(j, k) * sin(q[j] - q[k]) * q1[k] * q1[k]};
      momentum = momentum + Terms{a(j, k) * cos(q[j] - q[k]) * q1[k]};
    }
    x.equations.push_back(equation);
    x.momenta.push_back(momentum);
  }
  x.jacobi = *x.kinetic + *x.potential;
  return x;
}

Mechanics damped_oscillator(const Values& s) {
  const double m = s.at("m"), b = s.at("b"), k = s.at("k"), F = s.at("F");
  const double d = s.at("x"), d1 = s.at("x_dot"), d2 = s.at("x_ddot");
  Mechanics x;
  x.kinetic = {m * d1 * d1 / 2};
  x.potential = {k * d * d / 2};
  x.equations = {{m * d2, b * d1, k * d, -F}};
  x.accelerations = {1 / m * Terms{F, -b * d1, -k * d}};
  x.momenta = {{m * d1}};
  x.jacobi = {m * d1 * d1 / 2, k * d * d / 2};
  return x;
}

Mechanics magnetic_particle(const Values& s) {
  const double m = s.at("m"), qB = s.at("charge") * s.at("B"), px = s.at("x"), py = s.at("y");
  const double x1 = s.at("x_dot"), y1 = s.at("y_dot"), z1 = s.at("z_dot");
  Mechanics x;
  x.equations = {{m * s.at("x_ddot"), -qB * y1}, {m * s.at("y_ddot"), qB * x1}, {m * s.at("z_ddot")}};
  x.accelerations = {{qB / m * y1}, {-qB / m * x1}, Terms{0}};
  x.momenta = {{m * x1, -qB * py / 2}, {m * y1, qB * px / 2}, {m * z1}};
  x.jacobi = {m * x1 * x1 / 2, m * y1 * y1 / 2, m * z1 * z1 / 2};
  x.determinant = m * m * m;
  return x;
}

}  // namespace qdot::test
