#pragma once
// Taylor coefficients of the same equations, recurrences written by hand. T is double, or __float128 for
// references. Sources as in core/compile/taylor/expansion.hpp.

#include <quadmath.h>

#include <array>
#include <cmath>

#include "tests/bench/work_precision/equations.hpp"

namespace qdot::bench {

inline void sine_cosine(double x, double& s, double& c) {
  s = std::sin(x);
  c = std::cos(x);
}
inline void sine_cosine(__float128 x, __float128& s, __float128& c) { sincosq(x, &s, &c); }

template <class T, unsigned N>
using Series = std::array<T, N + 1>;

/// sum_{j=from}^{k} x_j y_{k-j}
template <class T, std::size_t Size>
T product(const std::array<T, Size>& x, const std::array<T, Size>& y, unsigned k, unsigned from = 0) {
  T sum = 0;
  for (unsigned j = from; j <= k; ++j) sum += x[j] * y[k - j];
  return sum;
}

/// s_k and c_k of an angle whose rate is known up to k - 1: k s_k = sum_j j u_j c_{k-j}, j u_j = rate_{j-1}.
template <class T, std::size_t Size>
void raise_sine_cosine(const std::array<T, Size>& rate, std::array<T, Size>& s, std::array<T, Size>& c,
                       unsigned k) {
  T sine = 0, cosine = 0;
  for (unsigned j = 1; j <= k; ++j) {
    sine += rate[j - 1] * c[k - j];
    cosine += rate[j - 1] * s[k - j];
  }
  s[k] = sine / k;
  c[k] = -cosine / k;
}

template <class T, unsigned N>
class SpringPendulumSeries {
 public:
  static constexpr std::size_t dimension = 4;
  explicit SpringPendulumSeries(const Problem& p)
      : stiffness_(T(p.parameter("k")) / p.parameter("m")), l0_(p.parameter("l0")), g_(p.parameter("g")) {}

  void expand(const std::array<T, 4>& y, std::array<Series<T, N>, 4>& x) {
    auto& [l, theta, u, w] = x;
    l[0] = y[0], theta[0] = y[1], u[0] = y[2], w[0] = y[3];
    sine_cosine(y[1], s_[0], c_[0]);
    for (unsigned k = 0; k < N; ++k) {
      if (k > 0) raise_sine_cosine(w, s_, c_, k);
      p_[k] = product(l, w, k);
      a_[k] = -(2 * product(u, w, k) + g_ * s_[k] + product(l, a_, k, 1)) / l[0];
      const T rest = k == 0 ? l0_ : T(0);
      l[k + 1] = u[k] / (k + 1);
      theta[k + 1] = w[k] / (k + 1);
      u[k + 1] = (product(p_, w, k) + g_ * c_[k] - stiffness_ * (l[k] - rest)) / (k + 1);
      w[k + 1] = a_[k] / (k + 1);
    }
  }

 private:
  T stiffness_, l0_, g_;
  Series<T, N> s_{}, c_{}, p_{}, a_{};
};

template <class T, unsigned N>
class WhirlingPendulumSeries {
 public:
  static constexpr std::size_t dimension = 2;
  explicit WhirlingPendulumSeries(const Problem& p)
      : spin2_(T(p.parameter("Omega")) * p.parameter("Omega")),
        rate2_(T(p.parameter("g")) / p.parameter("l")) {}

  void expand(const std::array<T, 2>& y, std::array<Series<T, N>, 2>& x) {
    auto& [theta, w] = x;
    theta[0] = y[0], w[0] = y[1];
    sine_cosine(y[0], s_[0], c_[0]);
    for (unsigned k = 0; k < N; ++k) {
      if (k > 0) raise_sine_cosine(w, s_, c_, k);
      theta[k + 1] = w[k] / (k + 1);
      w[k + 1] = (spin2_ * product(s_, c_, k) - rate2_ * s_[k]) / (k + 1);
    }
  }

 private:
  T spin2_, rate2_;
  Series<T, N> s_{}, c_{};
};

template <class T, unsigned N>
class RodSpringPendulumSeries {
 public:
  static constexpr std::size_t dimension = 6;
  explicit RodSpringPendulumSeries(const Problem& p)
      : l_(p.parameter("l")),
        stiffness_(T(p.parameter("k")) / p.parameter("m")),
        l0_(p.parameter("l0")),
        g_(p.parameter("g")) {}

  void expand(const std::array<T, 6>& y, std::array<Series<T, N>, 6>& x) {
    auto& [theta, phi, r, w, v, u] = x;
    for (std::size_t i = 0; i < 6; ++i) x[i][0] = y[i];
    sine_cosine(y[0], sine_theta_[0], cosine_theta_[0]);
    sine_cosine(y[1], sine_phi_[0], cosine_phi_[0]);
    sine_cosine(y[1] - y[0], s_[0], c_[0]);
    for (unsigned k = 0; k < N; ++k) {
      if (k > 0) {
        raise_sine_cosine(w, sine_theta_, cosine_theta_, k);
        raise_sine_cosine(v, sine_phi_, cosine_phi_, k);
        raise_sine_cosine(difference_, s_, c_, k);
      }
      difference_[k] = v[k] - w[k];
      pull_[k] = stiffness_ * (r[k] - (k == 0 ? l0_ : T(0)));
      w2_[k] = product(w, w, k);
      rv_[k] = product(r, v, k);
      a_[k] = (3 * product(pull_, s_, k) - T(1.5) * g_ * sine_theta_[k]) / l_;
      b_[k] = -(g_ * sine_phi_[k] + l_ * (product(a_, c_, k) + product(w2_, s_, k)) + 2 * product(u, v, k) +
                product(r, b_, k, 1)) /
              r[0];
      theta[k + 1] = w[k] / (k + 1);
      phi[k + 1] = v[k] / (k + 1);
      r[k + 1] = u[k] / (k + 1);
      w[k + 1] = a_[k] / (k + 1);
      v[k + 1] = b_[k] / (k + 1);
      u[k + 1] = (product(rv_, v, k) + l_ * (product(w2_, c_, k) - product(a_, s_, k)) - pull_[k] +
                  g_ * cosine_phi_[k]) /
                 (k + 1);
    }
  }

 private:
  T l_, stiffness_, l0_, g_;
  Series<T, N> sine_theta_{}, cosine_theta_{}, sine_phi_{}, cosine_phi_{}, s_{}, c_{};
  Series<T, N> difference_{}, pull_{}, w2_{}, rv_{}, a_{}, b_{};
};

template <class T, unsigned N>
class RodPendulumSeries {
 public:
  static constexpr std::size_t dimension = 4;
  explicit RodPendulumSeries(const Problem& p) : rate2_(T(p.parameter("g")) / p.parameter("l")) {}

  void expand(const std::array<T, 4>& y, std::array<Series<T, N>, 4>& x) {
    auto& [theta, phi, w, v] = x;
    for (std::size_t i = 0; i < 4; ++i) x[i][0] = y[i];
    sine_cosine(y[0], sine_theta_[0], cosine_theta_[0]);
    sine_cosine(y[1], sine_phi_[0], cosine_phi_[0]);
    sine_cosine(y[0] - y[1], s_[0], c_[0]);
    for (unsigned k = 0; k < N; ++k) {
      if (k > 0) {
        raise_sine_cosine(w, sine_theta_, cosine_theta_, k);
        raise_sine_cosine(v, sine_phi_, cosine_phi_, k);
        raise_sine_cosine(difference_, s_, c_, k);
      }
      difference_[k] = w[k] - v[k];
      w2_[k] = product(w, w, k);
      v2_[k] = product(v, v, k);
      determinant_[k] = (k == 0 ? T(4) / 3 : T(0)) - product(c_, c_, k);
      f_[k] = -product(v2_, s_, k) - T(1.5) * rate2_ * sine_theta_[k];
      h_[k] = product(w2_, s_, k) - rate2_ * sine_phi_[k];
      a_[k] = (f_[k] - product(c_, h_, k) - product(determinant_, a_, k, 1)) / determinant_[0];
      b_[k] = (T(4) / 3 * h_[k] - product(c_, f_, k) - product(determinant_, b_, k, 1)) / determinant_[0];
      theta[k + 1] = w[k] / (k + 1);
      phi[k + 1] = v[k] / (k + 1);
      w[k + 1] = a_[k] / (k + 1);
      v[k + 1] = b_[k] / (k + 1);
    }
  }

 private:
  T rate2_;
  Series<T, N> sine_theta_{}, cosine_theta_{}, sine_phi_{}, cosine_phi_{}, s_{}, c_{};
  Series<T, N> difference_{}, w2_{}, v2_{}, determinant_{}, f_{}, h_{}, a_{}, b_{};
};

}  // namespace qdot::bench
