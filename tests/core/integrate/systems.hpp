#pragma once
// Systems with known motions for the tests of core/integrate.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "core/integrate/integrate.hpp"
#include "core/integrate/methods.hpp"
#include "core/integrate/run.hpp"
#include "core/numerics/constants.hpp"

namespace qdot::integrate_test {

/// Those that need no more than the systems here have, values and a Jacobian, and choose their steps.
inline const std::vector<Method> all_methods = [] {
  std::vector<Method> found;
  for (const MethodRecord& record : methods()) {
    if (!record.has_fixed_step() && !record.expands()) found.push_back(record.method);
  }
  return found;
}();

inline const std::vector<Method> methods_of_fixed_step = [] {
  std::vector<Method> found;
  for (const MethodRecord& record : methods()) {
    if (record.has_fixed_step()) found.push_back(record.method);
  }
  return found;
}();

inline std::string_view name(Method method) { return record_of(method).name; }

/// A right-hand side from two functions that always have values.
template <class F, class J>
RightHandSide make_system(std::size_t dimension, F f, J jacobian) {
  return {dimension,
          [f](double t, std::span<const double> y, std::span<double> out) {
            f(t, y, out);
            return Evaluation::ok;
          },
          [jacobian](double t, std::span<const double> y, std::span<double> out) {
            jacobian(t, y, out);
            return Evaluation::ok;
          }};
}

inline void assign(std::span<double> out, std::initializer_list<double> values) {
  std::size_t i = 0;
  for (const double value : values) out[i++] = value;
}

/// x'' = -x. From (1, 0): x = cos t.
inline RightHandSide oscillator() {
  return make_system(
      2,
      [](double, auto y, auto f) {
        assign(f, {y[1], -y[0]});
      },
      [](double, auto, auto j) {
        assign(j, {0, 1, -1, 0});
      });
}

/// theta'' = -sin theta.
inline RightHandSide pendulum() {
  return make_system(
      2,
      [](double, auto y, auto f) {
        assign(f, {y[1], -std::sin(y[0])});
      },
      [](double, auto y, auto j) {
        assign(j, {0, 1, -std::cos(y[0]), 0});
      });
}

/// A weight on a spring: l, theta, l', theta' with k/m = 40, rest length 1, g = 9.81.
inline RightHandSide spring_pendulum() {
  return make_system(
      4,
      [](double, auto y, auto f) {
        const double l = y[0], th = y[1], v = y[2], w = y[3];
        assign(f, {v, w, l * w * w - 40 * (l - 1) + 9.81 * std::cos(th),
                   (-9.81 * std::sin(th) - 2 * v * w) / l});
      },
      [](double, auto y, auto j) {
        const double l = y[0], th = y[1], v = y[2], w = y[3];
        assign(j, {0, 0, 1, 0, 0, 0, 0, 1, w * w - 40, -9.81 * std::sin(th), 0, 2 * l * w,
                   (9.81 * std::sin(th) + 2 * v * w) / (l * l), -9.81 * std::cos(th) / l, -2 * w / l,
                   -2 * v / l});
      });
}

/// sn(u, k), cn(u, k), dn(u, k) by descending Landen transformations (Abramowitz and Stegun 16.4).
inline std::array<double, 3> jacobi_elliptic(double u, double k) {
  std::vector<double> a{1}, c{k};
  double b = std::sqrt(1 - k * k);
  while (std::abs(c.back()) > 1e-17) {
    const double a_next = (a.back() + b) / 2;
    c.push_back((a.back() - b) / 2);
    b = std::sqrt(a.back() * b);
    a.push_back(a_next);
  }
  double phi = std::ldexp(a.back() * u, static_cast<int>(a.size()) - 1);
  for (std::size_t n = a.size() - 1; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
  const double sn = std::sin(phi);
  return {sn, std::cos(phi), std::sqrt(1 - k * k * sn * sn)};
}

/// theta and theta' of the pendulum released at rest from theta_0, k = sin(theta_0 / 2):
/// sin(theta / 2) = k cn/dn(t). Source: Landau, Lifshitz, Mechanics, section 11, problem 1.
inline std::array<double, 2> released_pendulum(double t, double theta_0) {
  const double k = std::sin(theta_0 / 2);
  const auto [sn, cn, dn] = jacobi_elliptic(t, k);
  const double theta = 2 * std::asin(k * cn / dn);
  const double rate = -2 * k * std::sqrt(1 - k * k) * sn / dn;  // 2 (k cn/dn)' / cos(theta/2)
  return {theta, rate};
}

/// Released from theta_0, the pendulum is first vertical after K(k), a quarter of its period.
inline double quarter_period(double theta_0) { return std::comp_ellint_1(std::sin(theta_0 / 2)); }

/// n + 1 equally spaced instants.
inline std::vector<double> equal_grid(double from, double to, std::size_t n) {
  std::vector<double> grid(n + 1);
  for (std::size_t i = 0; i <= n; ++i) grid[i] = i == n ? to : from + (to - from) * (double(i) / double(n));
  return grid;
}

inline double row(const Run& run, std::size_t i, std::size_t component) {
  return run.states[i * run.y.size() + component];
}

/// max |computed - exact| over all rows and components; exact(t) returns the state.
template <class Exact>
double largest_error(const Run& run, std::span<const double> grid, Exact exact) {
  double error = 0;
  for (std::size_t i = 0; i < run.rows; ++i) {
    const auto state = exact(grid[i]);
    for (std::size_t k = 0; k < state.size(); ++k)
      error = std::max(error, std::abs(row(run, i, k) - state[k]));
  }
  return error;
}

/// A polynomial through nine values of g along a piece, and four times what it is off at 33 other places: an
/// independent road to EventFunction::series for any function.
inline double sampled_series(const EventFunction& event, const MotionPiece& piece, unsigned order,
                             std::span<double> c) {
  constexpr std::size_t nodes = 9, others = 33;
  const auto g = [&](double u) {
    std::vector<double> y;
    for (auto row = piece.rows; !row.empty(); row = row.subspan(piece.order + 1)) {
      double sum = 0;
      for (unsigned k = piece.order + 1; k-- > 0;) sum = sum * (u * piece.h) + row[k];
      y.push_back(sum);
    }
    return event.value(piece.t + u * piece.h, y);
  };
  std::vector<double> x(nodes), a(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    x[i] = 0.5 - 0.5 * std::cos(std::numbers::pi * double(i) / (nodes - 1));
    a[i] = g(x[i]);
  }
  for (std::size_t k = 1; k < nodes; ++k) {
    for (std::size_t i = nodes - 1; i >= k; --i) a[i] = (a[i] - a[i - 1]) / (x[i] - x[i - k]);
  }
  for (std::size_t k = nodes - 1; k-- > 0;) {
    for (std::size_t i = k; i + 1 < nodes; ++i) a[i] -= x[k] * a[i + 1];
  }
  a.resize(std::min<std::size_t>(nodes, order + 1));  // what is cut off shows in the difference
  double off = 0;
  for (std::size_t i = 0; i < others; ++i) {
    const double u = double(i) / (others - 1);
    double sum = 0;
    for (std::size_t k = a.size(); k-- > 0;) sum = sum * u + a[k];
    off = std::max(off, std::isnan(sum) ? infinity : 4 * std::abs(g(u) - sum));
    if (std::isnan(g(u))) off = infinity;
  }
  double power = 1;
  for (std::size_t k = 0; k < a.size(); ++k, power *= piece.h) c[k] = k == 0 ? a[0] : a[k] / power;
  return off;
}

inline void give_series(std::vector<EventFunction>& events) {
  for (EventFunction& event : events) {
    if (event.series) continue;
    event.series = [bare = event](const MotionPiece& piece, unsigned order, std::span<double> c) {
      return sampled_series(bare, piece, order, c);
    };
  }
}

/// integrate() with events that are plain functions.
inline Run integrated(const RightHandSide& system, RunRequest request) {
  give_series(request.events);
  return integrate(system, request);
}

}  // namespace qdot::integrate_test
