#include "tests/support/practice_mechanics.hpp"

namespace qdot::test {
namespace {

using std::cos;
using std::sin;

constexpr double square(double x) { return x * x; }

}  // namespace

Mechanics forced_spring_pendulum(const Values& s) {
  const double m = s.at("m"), k = s.at("k"), l0 = s.at("l0"), g = s.at("g"), F = s.at("F");
  const double l = s.at("l"), th = s.at("theta"), l1 = s.at("l_dot"), th1 = s.at("theta_dot");
  const double l2 = s.at("l_ddot"), th2 = s.at("theta_ddot");
  Mechanics x;
  x.kinetic = {m * l1 * l1 / 2, m * l * l * th1 * th1 / 2};
  x.potential = {-m * g * l * cos(th), k * square(l - l0) / 2};
  x.equations = {{m * l2, -m * l * th1 * th1, -m * g * cos(th), k * l, -k * l0, -F * sin(th)},
                 {m * l * l * th2, 2 * m * l * l1 * th1, m * g * l * sin(th), -F * l * cos(th)}};
  x.accelerations = {{l * th1 * th1, g * cos(th), -k / m * l, k / m * l0, F / m * sin(th)},
                     1 / l * Terms{-2 * l1 * th1, -g * sin(th), F / m * cos(th)}};
  x.momenta = {{m * l1}, {m * l * l * th1}};
  x.jacobi = *x.kinetic + *x.potential;
  x.determinant = m * m * l * l;
  return x;
}

Mechanics spring_pendulum(const Values& s) {
  Values unforced = s;
  unforced["F"] = 0;
  return forced_spring_pendulum(unforced);
}

Mechanics rolling_disk_platform(const Values& s) {
  const double m = s.at("m"), r = s.at("r"), W = s.at("Omega"), g = s.at("g"), Wt = W * s.at("t");
  const double q = s.at("q"), q1 = s.at("q_dot"), q2 = s.at("q_ddot");
  Mechanics x;
  x.kinetic = {m * q1 * q1 * 3 / 4, -m * r * W * q1 * 3 / 2, m * W * W * q * q / 2,
               m * r * r * W * W * 3 / 4};
  x.potential = {m * g * q * sin(Wt), m * g * r * cos(Wt)};
  x.equations = {{m * q2 * 3 / 2, -m * W * W * q, m * g * sin(Wt)}};
  x.accelerations = {{W * W * q * 2 / 3, -g * sin(Wt) * 2 / 3}};
  x.momenta = {{m * q1 * 3 / 2, -m * r * W * 3 / 2}};
  x.jacobi = {m * q1 * q1 * 3 / 4, -m * W * W * q * q / 2, -m * r * r * W * W * 3 / 4, m * g * q * sin(Wt),
              m * g * r * cos(Wt)};
  x.reaction = {m * g * cos(Wt), m * 2 * W * q1, -m * r * W * W};
  return x;
}

Mechanics cart_pendulum(const Values& s) {
  const double M = s.at("M"), m = s.at("m"), k = s.at("k"), l = s.at("l"), g = s.at("g");
  const double x0 = s.at("x"), th = s.at("theta"), x1 = s.at("x_dot"), th1 = s.at("theta_dot");
  const double x2 = s.at("x_ddot"), th2 = s.at("theta_ddot"), D = M + m * square(sin(th));
  Mechanics x;
  x.kinetic = {(M + m) * x1 * x1 / 2, m * l * x1 * th1 * cos(th), m * l * l * th1 * th1 / 2};
  x.potential = {k * x0 * x0 / 2, -m * g * l * cos(th)};
  x.equations = {{(M + m) * x2, m * l * th2 * cos(th), -m * l * th1 * th1 * sin(th), k * x0},
                 {m * l * l * th2, m * l * x2 * cos(th), m * g * l * sin(th)}};
  const Terms cart = 1 / D * Terms{m * sin(th) * l * th1 * th1, m * sin(th) * g * cos(th), -k * x0};
  x.accelerations = {cart, Terms{-g / l * sin(th)} + -cos(th) / l * cart};
  x.momenta = {{(M + m) * x1, m * l * th1 * cos(th)}, {m * l * l * th1, m * l * x1 * cos(th)}};
  x.jacobi = *x.kinetic + *x.potential;
  x.determinant = m * l * l * D;
  return x;
}

Mechanics rod_pendulum(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), g = s.at("g"), ml2 = m * l * l, G = g / l;
  const double th = s.at("theta"), ph = s.at("phi"), th1 = s.at("theta_dot"), ph1 = s.at("phi_dot");
  const double th2 = s.at("theta_ddot"), ph2 = s.at("phi_ddot"), d = th - ph;
  Mechanics x;
  x.kinetic = {ml2 * th1 * th1 * 2 / 3, ml2 * ph1 * ph1 / 2, ml2 * th1 * ph1 * cos(d)};
  x.potential = {-m * g * l * cos(th) * 3 / 2, -m * g * l * cos(ph)};
  x.equations = {
      {ml2 * th2 * 4 / 3, ml2 * cos(d) * ph2, ml2 * ph1 * ph1 * sin(d), m * g * l * sin(th) * 3 / 2},
      {ml2 * ph2, ml2 * cos(d) * th2, -ml2 * th1 * th1 * sin(d), m * g * l * sin(ph)}};
  const Terms rod =
      1 / (4.0 / 3 - square(cos(d))) *
      Terms{-ph1 * ph1 * sin(d), -G * sin(th) * 3 / 2, -cos(d) * th1 * th1 * sin(d), cos(d) * G * sin(ph)};
  x.accelerations = {rod, Terms{th1 * th1 * sin(d), -G * sin(ph)} + -cos(d) * rod};
  x.momenta = {{ml2 * th1 * 4 / 3, ml2 * ph1 * cos(d)}, {ml2 * ph1, ml2 * th1 * cos(d)}};
  x.jacobi = *x.kinetic + *x.potential;
  x.reaction = {m * g * cos(ph), m * l * ph1 * ph1, m * l * th1 * th1 * cos(d), m * l * th2 * sin(d)};
  x.determinant = ml2 * ml2 * (4.0 / 3 - square(cos(d)));
  return x;
}

Mechanics rod_spring_pendulum(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), k = s.at("k"), l0 = s.at("l0"), g = s.at("g");
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot");
  const double ph = s.at("phi"), ph1 = s.at("phi_dot"), ph2 = s.at("phi_ddot");
  const double r = s.at("r"), r1 = s.at("r_dot"), r2 = s.at("r_ddot"), e = ph - th, S = k * (r - l0);
  Mechanics x;
  x.kinetic = {m * l * l * th1 * th1 * 2 / 3, m * r1 * r1 / 2, m * r * r * ph1 * ph1 / 2,
               m * l * th1 * r * ph1 * cos(e), m * l * th1 * r1 * sin(e)};
  x.potential = {-m * g * l * cos(th) * 3 / 2, -m * g * r * cos(ph), S * (r - l0) / 2};
  x.equations = {
      {m * l * l * th2 * 4 / 3, m * l * r * ph2 * cos(e), m * l * r2 * sin(e), m * l * 2 * r1 * ph1 * cos(e),
       -m * l * r * ph1 * ph1 * sin(e), m * g * l * sin(th) * 3 / 2},
      {m * r * r * ph2, m * r * 2 * r1 * ph1, m * r * l * th2 * cos(e), m * r * l * th1 * th1 * sin(e),
       m * g * r * sin(ph)},
      {m * r2, -m * r * ph1 * ph1, m * l * th2 * sin(e), -m * l * th1 * th1 * cos(e), -m * g * cos(ph), k * r,
       -k * l0}};
  const Terms rod = {3 * S * sin(e) / (m * l), -3 * g / l / 2 * sin(th)};
  x.accelerations = {
      rod, 1 / r * (Terms{-2 * r1 * ph1, -l * th1 * th1 * sin(e), -g * sin(ph)} + -l * cos(e) * rod),
      Terms{r * ph1 * ph1, l * th1 * th1 * cos(e), g * cos(ph), -S / m} + -l * sin(e) * rod};
  x.momenta = {{m * l * l * th1 * 4 / 3, m * l * r * ph1 * cos(e), m * l * r1 * sin(e)},
               {m * r * r * ph1, m * r * l * th1 * cos(e)},
               {m * r1, m * l * th1 * sin(e)}};
  x.jacobi = *x.kinetic + *x.potential;
  x.determinant = m * m * m * l * l * r * r / 3;
  return x;
}

Mechanics whirling_pendulum(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), R = s.at("R"), W = s.at("Omega"), g = s.at("g");
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot"), ml2 = m * l * l;
  Mechanics x;
  x.kinetic = {ml2 * th1 * th1 / 2, m * R * W * l * th1 * cos(th), m * W * W * R * R / 2,
               ml2 * W * W * square(sin(th)) / 2};
  x.potential = {-m * g * l * cos(th)};
  x.equations = {{ml2 * th2, -ml2 * W * W * sin(th) * cos(th), m * g * l * sin(th)}};
  x.accelerations = {{sin(th) * W * W * cos(th), -sin(th) * g / l}};
  x.momenta = {{ml2 * th1, m * R * W * l * cos(th)}};
  x.jacobi = {ml2 * th1 * th1 / 2, -m * W * W * R * R / 2, -ml2 * W * W * square(sin(th)) / 2,
              -m * g * l * cos(th)};
  return x;
}

Mechanics orbiting_pendulum(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), r = s.at("r"), w = s.at("omega0");
  const double ph = s.at("phi"), ph1 = s.at("phi_dot"), ph2 = s.at("phi_ddot"), ml2 = m * l * l;
  Mechanics x;
  x.kinetic = {ml2 * ph1 * ph1 / 2,         m * w * ph1 * r * l * cos(ph), ml2 * w * ph1,
               m * w * w * r * l * cos(ph), m * w * w * r * r / 2,         ml2 * w * w / 2};
  x.potential = Terms{0};
  x.equations = {{ml2 * ph2, m * l * r * w * w * sin(ph)}};
  x.accelerations = {{-r / l * w * w * sin(ph)}};
  x.momenta = {{ml2 * ph1, m * w * r * l * cos(ph), ml2 * w}};
  x.jacobi = {ml2 * ph1 * ph1 / 2, -m * w * w * r * l * cos(ph), -m * w * w * r * r / 2, -ml2 * w * w / 2};
  x.reaction = {m * l * w * w, m * l * 2 * w * ph1, m * l * ph1 * ph1, m * r * w * w * cos(ph)};
  return x;
}

Mechanics free_spin_pendulum(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), g = s.at("g"), ml2 = m * l * l;
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot");
  const double psi1 = s.at("psi_dot"), psi2 = s.at("psi_ddot"), A = 0.5 + sin(th);
  Mechanics x;
  x.kinetic = {ml2 * th1 * th1 / 2, ml2 * A * A * psi1 * psi1 / 2};
  x.potential = {-m * g * l * cos(th)};
  x.equations = {{ml2 * th2, -ml2 * A * cos(th) * psi1 * psi1, m * g * l * sin(th)},
                 {ml2 * A * A * psi2, 2 * ml2 * A * cos(th) * th1 * psi1}};
  x.accelerations = {{psi1 * psi1 * A * cos(th), -g / l * sin(th)}, {-2 * psi1 * th1 * cos(th) / A}};
  x.momenta = {{ml2 * th1}, {ml2 * A * A * psi1}};
  x.jacobi = {ml2 * th1 * th1 / 2, ml2 * A * A * psi1 * psi1 / 2, -m * g * l * cos(th)};
  x.determinant = ml2 * ml2 * A * A;
  return x;
}

Mechanics compass_walker(const Values& s) {
  const double M = s.at("M"), mu = s.at("m") / M, l = s.at("l"), gamma = s.at("gamma"), G = s.at("g") / l;
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot");
  const double ph = s.at("phi"), ph1 = s.at("phi_dot"), ph2 = s.at("phi_ddot");
  const double Ml2 = M * l * l, c = cos(ph), sn = sin(ph), half = sin(ph / 2), rise = ph / 2 - th + gamma;
  Mechanics x;
  x.kinetic = {Ml2 * th1 * th1 / 2, Ml2 * 2 * mu * half * half * th1 * th1,
               -Ml2 * 2 * mu * half * half * th1 * ph1, Ml2 * mu * ph1 * ph1 / 2};
  x.potential = {Ml2 * G * cos(th - gamma), Ml2 * G * 2 * mu * half * sin(rise)};
  x.equations = {
      {Ml2 * (1 + 2 * mu * (1 - c)) * th2, -Ml2 * mu * (1 - c) * ph2, Ml2 * 2 * mu * sn * ph1 * th1,
       -Ml2 * mu * sn * ph1 * ph1, -Ml2 * G * sin(th - gamma), -Ml2 * G * 2 * mu * half * cos(rise)},
      {Ml2 * mu * ph2, -Ml2 * mu * (1 - c) * th2, -Ml2 * mu * sn * th1 * th1,
       -Ml2 * mu * G * sin(th - ph - gamma)}};
  const Terms stance = 1 / (1 + mu * sn * sn) *
                       Terms{G * (1 + mu) * sin(th - gamma), -G * mu * c * sin(th - ph - gamma),
                             mu * sn * (1 - c) * th1 * th1, -mu * sn * 2 * th1 * ph1, mu * sn * ph1 * ph1};
  x.accelerations = {stance, Terms{sn * th1 * th1, G * sin(th - ph - gamma)} + (1 - c) * stance};
  x.momenta = {{Ml2 * (1 + 2 * mu * (1 - c)) * th1, -Ml2 * mu * (1 - c) * ph1},
               {Ml2 * mu * ph1, -Ml2 * mu * (1 - c) * th1}};
  x.jacobi = *x.kinetic + *x.potential;
  x.determinant = Ml2 * Ml2 * mu * (1 + mu * sn * sn);
  return x;
}

Mechanics rotating_l_bar(const Values& s) {
  const double m = s.at("m"), l = s.at("l"), W = s.at("Omega"), g = s.at("g"), ml2 = m * l * l;
  const double th = s.at("theta"), th1 = s.at("theta_dot"), th2 = s.at("theta_ddot");
  const double sn = sin(th), c = cos(th), W2 = W * W;
  const Terms spin = ml2 * W2 * Terms{sn * sn * 9, c * c / 6, -sn * c * 1.5};
  Mechanics x;
  x.kinetic = Terms{ml2 * th1 * th1 * 55 / 6} + spin;
  x.potential = {-m * g * l * c * 15 / 2, -m * g * l * sn / 2};
  x.equations = {{ml2 * th2 * 55 / 3, -ml2 * W2 * sn * c * 53 / 3, -ml2 * W2 * sn * sn * 1.5,
                  ml2 * W2 * c * c * 1.5, m * g * l * sn * 15 / 2, -m * g * l * c / 2}};
  x.accelerations = {
      3.0 / 55 * Terms{W2 * 53 / 6 * sin(2 * th), -W2 * 1.5 * cos(2 * th), -g / l * 7.5 * sn, g / l * c / 2}};
  x.momenta = {{ml2 * th1 * 55 / 3}};
  x.jacobi = Terms{ml2 * th1 * th1 * 55 / 6} + -1 * spin + *x.potential;
  return x;
}

}  // namespace qdot::test
