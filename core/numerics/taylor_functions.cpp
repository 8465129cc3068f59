// The functions of one argument (core/numerics/taylor_enclosure.hpp).

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/numerics/constants.hpp"
#include "core/numerics/taylor_enclosure.hpp"
#include "core/numerics/taylor_rows.hpp"
#include "core/numerics/whole_power.hpp"

namespace qdot {
namespace {

/// u_1^k / k! times the k-th derivative, which `derivative(k)` gives: of a function of a linear argument.
template <class T, std::size_t N1, class Derivative>
void of_linear(std::array<T, N1>& w, const T& u_1, const Derivative& derivative) {
  T factor(1.0);
  for (std::size_t k = 0; k < N1; ++k) {
    if (k > 0) factor = rows::times(factor, u_1) / T(static_cast<double>(k));
    w[k] = rows::times(factor, derivative(k));
  }
}

/// Sine and cosine of u, up to the order of the rows.
template <class T, std::size_t N1>
void write_waves(std::array<T, N1>& sine, std::array<T, N1>& cosine, const std::array<T, N1>& u,
                 std::size_t u_terms) {
  const T s = sin(u[0]), c = cos(u[0]);
  sine[0] = s;
  cosine[0] = c;
  if (u_terms == 2) {
    const T turned[4]{s, c, -s, -c};
    of_linear(sine, u[1], [&](std::size_t k) { return turned[k % 4]; });
    of_linear(cosine, u[1], [&](std::size_t k) { return turned[(k + 1) % 4]; });
  } else if (u_terms > 2) {
    const auto slopes = rows::slopes_of(u, u_terms);
    for (std::size_t k = 1; k < N1; ++k) {
      sine[k] = rows::integrated(slopes, u_terms, cosine, k);
      cosine[k] = -rows::integrated(slopes, u_terms, sine, k);
    }
  }
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> exponential(const TaylorEnclosure<N, C>& u) {
  return rows::both<N, C>(u.terms == 1 ? 1 : N + 1, u.reach, [&](auto& w, const auto& row) {
    const auto& a = row(u);
    w[0] = evaluate(Function::exp, a[0]);
    if (u.terms == 2) {
      const auto value = w[0];
      of_linear(w, a[1], [&](std::size_t) { return value; });
    } else if (u.terms > 2) {
      const auto slopes = rows::slopes_of(a, u.terms);
      for (std::size_t k = 1; k <= N; ++k) w[k] = rows::integrated(slopes, u.terms, w, k);
    }
  });
}

/// sinh (0) and cosh (1) are each other's derivatives.
template <std::size_t N, class C>
TaylorEnclosure<N, C> hyperbolic(const TaylorEnclosure<N, C>& u, std::size_t which) {
  return rows::both<N, C>(u.terms == 1 ? 1 : N + 1, u.reach, [&](auto& w, const auto& row) {
    const auto& a = row(u);
    const auto slopes = rows::slopes_of(a, u.terms);
    auto pair = std::array{a, a};
    pair[0][0] = evaluate(Function::sinh, a[0]);
    pair[1][0] = evaluate(Function::cosh, a[0]);
    for (std::size_t k = 1; k <= N && u.terms > 1; ++k) {
      const auto odd = rows::integrated(slopes, u.terms, pair[1], k);
      pair[1][k] = rows::integrated(slopes, u.terms, pair[0], k);
      pair[0][k] = odd;
    }
    w = pair[which];
  });
}

/// f(u) of which f(u_0) is known, and the series of f'(u).
template <std::size_t N, class C>
TaylorEnclosure<N, C> from_derivative(Function function, const TaylorEnclosure<N, C>& u,
                                      const TaylorEnclosure<N, C>& derivative) {
  return rows::both<N, C>(N + 1, u.reach, [&](auto& w, const auto& row) {
    w[0] = evaluate(function, row(u)[0]);
    const auto slopes = rows::slopes_of(row(u), u.terms);
    for (std::size_t k = 1; k <= N; ++k) w[k] = rows::integrated(slopes, u.terms, row(derivative), k);
  });
}

/// 1 - tanh^2 u = 1/cosh^2 u.
Interval slope_of_tanh(const Interval& u, const Interval& tanh) {
  return intersection(Interval(1) - square(tanh), square(Interval(1) / evaluate(Function::cosh, u)));
}
Ball slope_of_tanh(const Ball& u, const Ball& tanh) {
  const Ball slope = square(Ball(1) / evaluate(Function::cosh, u));
  return slope.is_finite() ? slope : Ball::of(slope_of_tanh(u.interval(), tanh.interval()));
}

/// Nothing is known.
void forget(Interval& x) { x = Interval::whole(); }
Interval unit_range(const Interval&) { return {-1, 1}; }
Ball unit_range(const Ball&) { return {DoubleDouble{}, 1}; }
void forget(Ball& x) { x = Ball(DoubleDouble{}, infinity); }

/// w' = (1 - w^2) u'.
template <std::size_t N, class C>
TaylorEnclosure<N, C> hyperbolic_tangent(const TaylorEnclosure<N, C>& u) {
  return rows::both<N, C>(N + 1, u.reach, [&](auto& w, const auto& row) {
    w[0] = evaluate(Function::tanh, row(u)[0]);
    const auto slopes = rows::slopes_of(row(u), u.terms);
    auto slope = row(u);
    slope[0] = slope_of_tanh(row(u)[0], w[0]);
    for (std::size_t k = 1; k <= N; ++k) {
      w[k] = rows::integrated(slopes, u.terms, slope, k);
      slope[k] = -rows::convolution(w, k + 1, w, k + 1, k, 0, k);
    }
  });
}

/// |u| and sign u: by their side, which is that of the whole piece.
template <std::size_t N, class C>
TaylorEnclosure<N, C> sided(Function function, const TaylorEnclosure<N, C>& u) {
  const Interval& range = u.over[0];
  const bool bends = function == Function::abs;
  const bool above = range.lower > 0 || (bends && range.lower == 0 && range.upper > 0);
  const bool below = range.upper < 0 || (bends && range.upper == 0 && range.lower < 0);
  if (above || below) {
    if (!bends) return TaylorEnclosure<N, C>::constant(above ? 1.0 : -1.0);
    return above ? u : TaylorEnclosure<N, C>::literal(-1) * u;
  }
  return rows::both<N, C>(N + 1, u.reach, [&](auto& w, const auto& row) {
    using T = std::decay_t<decltype(w[0])>;
    std::ranges::for_each(w, [](T& coefficient) { forget(coefficient); });
    w[0] = evaluate(function, row(u)[0]);
    if (bends) w[1] = unit_range(w[1]) * row(u)[1];
  });
}

}  // namespace

template <std::size_t N, class C>
std::pair<TaylorEnclosure<N, C>, TaylorEnclosure<N, C>> sine_cosine(const TaylorEnclosure<N, C>& u) {
  TaylorEnclosure<N, C> sine, cosine;
  sine.terms = cosine.terms = u.terms == 1 ? 1 : N + 1;
  sine.reach = cosine.reach = u.reach;
  write_waves(sine.at, cosine.at, u.at, u.terms);
  write_waves(sine.over, cosine.over, u.over, u.terms);
  rows::tighten(sine);
  rows::tighten(cosine);
  return {sine, cosine};
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> sin(const TaylorEnclosure<N, C>& u) {
  return sine_cosine(u).first;
}
template <std::size_t N, class C>
TaylorEnclosure<N, C> cos(const TaylorEnclosure<N, C>& u) {
  return sine_cosine(u).second;
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> power(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& constant) {
  const Interval exponent = rows::enclosed(constant.at[0]);
  if (u.terms == 1) return TaylorEnclosure<N, C>::constant(power(u.at[0], constant.at[0]));
  constexpr double most_multiplied = 1024;
  const double n = exponent.lower;
  if (n == exponent.upper && n == std::nearbyint(n) && std::abs(n) <= most_multiplied && n != 0) {
    const TaylorEnclosure<N, C> raised = whole_power(u, static_cast<int>(std::abs(n)));
    return n > 0 ? raised : TaylorEnclosure<N, C>::literal(1.0) / raised;
  }
  return rows::both<N, C>(N + 1, u.reach, [&](auto& w, const auto& row) {
    using T = std::decay_t<decltype(w[0])>;
    const auto& a = row(u);
    const T& p = row(constant)[0];
    w[0] = power(a[0], p);
    for (std::size_t k = 1; k <= N; ++k) {  // w' u = p u' w
      T sum(0.0);
      for (std::size_t j = 1; j <= k && j < u.terms; ++j) {
        const T factor = p * T(static_cast<double>(j)) - T(static_cast<double>(k - j));
        const T term = factor * rows::times(a[j], w[k - j]);
        sum = j == 1 ? term : sum + term;
      }
      w[k] = sum / (T(static_cast<double>(k)) * a[0]);
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> evaluate(Function function, const TaylorEnclosure<N, C>& u) {
  using Enclosure = TaylorEnclosure<N, C>;
  if (u.terms == 1) return Enclosure::constant(evaluate(function, u.at[0]));
  const auto one = Enclosure::literal(1), minus = Enclosure::literal(-1);
  switch (function) {
    case Function::sin:
      return sin(u);
    case Function::cos:
      return cos(u);
    case Function::tan:
      return sin(u) / cos(u);
    case Function::exp:
      return exponential(u);
    case Function::sinh:
      return hyperbolic(u, 0);
    case Function::cosh:
      return hyperbolic(u, 1);
    case Function::tanh:
      return hyperbolic_tangent(u);
    case Function::log:
      return from_derivative(function, u, one / u);
    case Function::atan:
      return from_derivative(function, u, one / (one + square(u)));
    case Function::asin:
      return from_derivative(function, u, one / sqrt(one + minus * square(u)));
    case Function::acos:
      return from_derivative(function, u, minus / sqrt(one + minus * square(u)));
    case Function::abs:
    case Function::sign:
      break;
  }
  return sided(function, u);
}

template Curvature sin(const Curvature&);
template Curvature cos(const Curvature&);
template Curvature power(const Curvature&, const Curvature&);
template Curvature evaluate(Function, const Curvature&);
template std::pair<Curvature, Curvature> sine_cosine(const Curvature&);

template FineSeries sin(const FineSeries&);
template FineSeries cos(const FineSeries&);
template FineSeries power(const FineSeries&, const FineSeries&);
template FineSeries evaluate(Function, const FineSeries&);
template std::pair<FineSeries, FineSeries> sine_cosine(const FineSeries&);

}  // namespace qdot
