#include "core/numerics/taylor_enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/numerics/constants.hpp"
#include "core/numerics/product_sum.hpp"
#include "core/numerics/whole_power.hpp"

namespace qdot {
namespace {

template <class T, std::size_t N>
using Series = std::array<T, N + 1>;

Interval enclosed(const Interval& x) { return x; }
Interval enclosed(const Ball& x) { return x.interval(); }

/// 1 x would be rounded once more.
Interval times(const Interval& a, const Interval& b) {
  if (a.lower == 1 && a.upper == 1) return b;
  return b.lower == 1 && b.upper == 1 ? a : a * b;
}
Ball times(const Ball& a, const Ball& b) { return a * b; }

bool is_nothing(const Interval& x) { return x.lower == 0 && x.upper == 0; }
bool is_nothing(const Ball& x) { return x.is_zero(); }
bool is_unknown(const Interval& x) { return !x.is_finite(); }
bool is_unknown(const Ball& x) { return !x.is_finite(); }

/// sum_j v_j w_{k-j} over j = first .. last. What is exactly zero stays so, and one product is rounded once.
template <class T, std::size_t N1>
T dot(const std::array<T, N1>& v, const std::array<T, N1>& w, std::size_t k, std::size_t first,
      std::size_t last) {
  if (first == last) return times(v[first], w[k - first]);
  ProductSum<T> sum;
  std::size_t one{};
  std::size_t terms = 0;
  for (std::size_t j = first; j <= last; ++j) {
    if (is_nothing(v[j]) || is_nothing(w[k - j])) continue;
    sum.add(v[j], w[k - j]);
    one = j;
    ++terms;
  }
  if (terms < 2) return terms == 0 ? T(0.0) : times(v[one], w[k - one]);
  const T total = sum.total();
  if (!is_unknown(total)) return total;
  T by_steps = times(v[first], w[k - first]);
  for (std::size_t j = first + 1; j <= last; ++j) by_steps = by_steps + times(v[j], w[k - j]);
  return by_steps;
}

/// f_k(X) by the mean value theorem, from the highest order down.
template <std::size_t N, class C>
void tighten(TaylorEnclosure<N, C>& w) {
  if (w.terms == 1 || w.reach.width() == 0) return;
  for (std::size_t k = std::min(N, w.terms - 1); k-- > 0;) {
    const Interval change = Interval(static_cast<double>(k + 1)) * w.over[k + 1] * w.reach;
    w.over[k] = intersection(w.over[k], enclosed(w.at[k]) + change);
  }
}

/// Both rows of the result by the same recurrence.
template <std::size_t N, class C, class Recurrence>
TaylorEnclosure<N, C> both(std::size_t terms, const Interval& reach, const Recurrence& recurrence) {
  TaylorEnclosure<N, C> w;
  w.terms = std::min(terms, N + 1);
  w.reach = reach;
  recurrence(
      w.at, [](const TaylorEnclosure<N, C>& u) -> const auto& { return u.at; });
  recurrence(
      w.over, [](const TaylorEnclosure<N, C>& u) -> const auto& { return u.over; });
  tighten(w);
  return w;
}

/// That of the one that is not constant.
template <std::size_t N, class C>
const Interval& reach_of(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v) {
  return u.terms > 1 ? u.reach : v.reach;
}

/// sum_j v_j w_{k-j} over j = first .. last, as far as v and w have terms.
template <class T, std::size_t N1>
T convolution(const std::array<T, N1>& v, std::size_t v_terms, const std::array<T, N1>& w,
              std::size_t w_terms, std::size_t k, std::size_t first, std::size_t last) {
  first = std::max(first, k < w_terms ? 0 : k - w_terms + 1);
  last = std::min(last, v_terms - 1);
  return first > last || last > k ? T(0.0) : dot(v, w, k, first, last);
}

/// Subtracting nothing rounds nothing.
template <class T>
T difference(const T& a, const T& b) {
  return is_nothing(b) ? a : a - b;
}

/// j u_j, the coefficients of t u'.
template <class T, std::size_t N1>
std::array<T, N1> slopes_of(const std::array<T, N1>& u, std::size_t u_terms) {
  std::array<T, N1> slopes;
  for (std::size_t j = 1; j < N1 && j < u_terms; ++j) slopes[j] = times(T(static_cast<double>(j)), u[j]);
  return slopes;
}

/// sum_{j=1}^{k} j u_j v_{k-j} / k: the coefficient k of the integral of u' v, from slopes_of(u).
template <class T, std::size_t N1>
T integrated(const std::array<T, N1>& slopes, std::size_t u_terms, const std::array<T, N1>& v,
             std::size_t k) {
  return dot(slopes, v, k, 1, std::min(k, u_terms - 1)) / T(static_cast<double>(k));
}

/// u_1^k / k! times the k-th derivative, which `derivative(k)` gives: of a function of a linear argument.
template <class T, std::size_t N1, class Derivative>
void of_linear(std::array<T, N1>& w, const T& u_1, const Derivative& derivative) {
  T factor(1.0);
  for (std::size_t k = 0; k < N1; ++k) {
    if (k > 0) factor = times(factor, u_1) / T(static_cast<double>(k));
    w[k] = times(factor, derivative(k));
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
    const auto slopes = slopes_of(u, u_terms);
    for (std::size_t k = 1; k < N1; ++k) {
      sine[k] = integrated(slopes, u_terms, cosine, k);
      cosine[k] = -integrated(slopes, u_terms, sine, k);
    }
  }
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> exponential(const TaylorEnclosure<N, C>& u) {
  return both<N, C>(u.terms == 1 ? 1 : N + 1, u.reach, [&](auto& w, const auto& row) {
    const auto& a = row(u);
    w[0] = evaluate(Function::exp, a[0]);
    if (u.terms == 2) {
      const auto value = w[0];
      of_linear(w, a[1], [&](std::size_t) { return value; });
    } else if (u.terms > 2) {
      const auto slopes = slopes_of(a, u.terms);
      for (std::size_t k = 1; k <= N; ++k) w[k] = integrated(slopes, u.terms, w, k);
    }
  });
}

/// sinh (0) and cosh (1) are each other's derivatives.
template <std::size_t N, class C>
TaylorEnclosure<N, C> hyperbolic(const TaylorEnclosure<N, C>& u, std::size_t which) {
  return both<N, C>(u.terms == 1 ? 1 : N + 1, u.reach, [&](auto& w, const auto& row) {
    const auto& a = row(u);
    const auto slopes = slopes_of(a, u.terms);
    auto pair = std::array{a, a};
    pair[0][0] = evaluate(Function::sinh, a[0]);
    pair[1][0] = evaluate(Function::cosh, a[0]);
    for (std::size_t k = 1; k <= N && u.terms > 1; ++k) {
      const auto odd = integrated(slopes, u.terms, pair[1], k);
      pair[1][k] = integrated(slopes, u.terms, pair[0], k);
      pair[0][k] = odd;
    }
    w = pair[which];
  });
}

/// f(u) of which f(u_0) is known, and the series of f'(u).
template <std::size_t N, class C>
TaylorEnclosure<N, C> from_derivative(Function function, const TaylorEnclosure<N, C>& u,
                                      const TaylorEnclosure<N, C>& derivative) {
  return both<N, C>(N + 1, u.reach, [&](auto& w, const auto& row) {
    w[0] = evaluate(function, row(u)[0]);
    const auto slopes = slopes_of(row(u), u.terms);
    for (std::size_t k = 1; k <= N; ++k) w[k] = integrated(slopes, u.terms, row(derivative), k);
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
  return both<N, C>(N + 1, u.reach, [&](auto& w, const auto& row) {
    w[0] = evaluate(Function::tanh, row(u)[0]);
    const auto slopes = slopes_of(row(u), u.terms);
    auto slope = row(u);
    slope[0] = slope_of_tanh(row(u)[0], w[0]);
    for (std::size_t k = 1; k <= N; ++k) {
      w[k] = integrated(slopes, u.terms, slope, k);
      slope[k] = -convolution(w, k + 1, w, k + 1, k, 0, k);
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
  return both<N, C>(N + 1, u.reach, [&](auto& w, const auto& row) {
    using T = std::decay_t<decltype(w[0])>;
    std::ranges::for_each(w, [](T& coefficient) { forget(coefficient); });
    w[0] = evaluate(function, row(u)[0]);
    if (bends) w[1] = unit_range(w[1]) * row(u)[1];
  });
}

}  // namespace

template <std::size_t N, class C>
TaylorEnclosure<N, C> TaylorEnclosure<N, C>::constant(const C& value) {
  TaylorEnclosure<N, C> result;
  result.at[0] = value;
  result.over[0] = enclosed(value);
  return result;
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> TaylorEnclosure<N, C>::variable(const C& centre, const Interval& piece) {
  TaylorEnclosure<N, C> result;
  result.at[0] = centre;
  result.over[0] = piece;
  result.at[1] = C(1.0);
  result.over[1] = 1;
  result.terms = 2;
  result.reach = piece - enclosed(centre);
  return result;
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> operator+(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v) {
  return both<N, C>(std::max(u.terms, v.terms), reach_of(u, v), [&](auto& w, const auto& row) {
    for (std::size_t k = 0; k <= N; ++k) {
      w[k] = k >= u.terms ? row(v)[k] : k >= v.terms ? row(u)[k] : row(u)[k] + row(v)[k];
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> operator*(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v) {
  const std::size_t terms = std::min(u.terms + v.terms - 1, N + 1);
  return both<N, C>(terms, reach_of(u, v), [&](auto& w, const auto& row) {
    for (std::size_t k = 0; k < terms; ++k) {
      w[k] = convolution(row(u), u.terms, row(v), v.terms, k, 0, k);
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> operator/(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v) {
  const std::size_t terms = v.terms == 1 ? u.terms : N + 1;
  return both<N, C>(terms, reach_of(u, v), [&](auto& w, const auto& row) {
    for (std::size_t k = 0; k < terms; ++k) {
      const auto known = convolution(row(v), v.terms, w, terms, k, 1, k);
      w[k] = difference(row(u)[k], known) / row(v)[0];
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> square(const TaylorEnclosure<N, C>& u) {
  const std::size_t terms = std::min(2 * u.terms - 1, N + 1);
  return both<N, C>(terms, u.reach, [&](auto& w, const auto& row) {
    using T = std::decay_t<decltype(w[0])>;
    const auto& a = row(u);
    for (std::size_t k = 0; k < terms; ++k) {
      const std::size_t before = (k + 1) / 2;  // pairs j, k - j with j < k - j
      const T pairs = before == 0 ? T(0.0) : convolution(a, u.terms, a, u.terms, k, 0, before - 1);
      const T both_ways = pairs + pairs;
      if (k % 2 != 0 || k / 2 >= u.terms) {
        w[k] = both_ways;
      } else {
        w[k] = is_nothing(pairs) ? square(a[k / 2]) : both_ways + square(a[k / 2]);
      }
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> sqrt(const TaylorEnclosure<N, C>& u) {
  const std::size_t terms = u.terms == 1 ? 1 : N + 1;
  return both<N, C>(terms, u.reach, [&](auto& w, const auto& row) {
    w[0] = sqrt(row(u)[0]);
    const auto twice = w[0] + w[0];
    for (std::size_t k = 1; k < terms; ++k) {
      const auto known = convolution(w, terms, w, terms, k, 1, k - 1);
      w[k] = difference(row(u)[k], known) / twice;
    }
  });
}

template <std::size_t N, class C>
std::pair<TaylorEnclosure<N, C>, TaylorEnclosure<N, C>> sine_cosine(const TaylorEnclosure<N, C>& u) {
  TaylorEnclosure<N, C> sine, cosine;
  sine.terms = cosine.terms = u.terms == 1 ? 1 : N + 1;
  sine.reach = cosine.reach = u.reach;
  write_waves(sine.at, cosine.at, u.at, u.terms);
  write_waves(sine.over, cosine.over, u.over, u.terms);
  tighten(sine);
  tighten(cosine);
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
  const Interval exponent = enclosed(constant.at[0]);
  if (u.terms == 1) return TaylorEnclosure<N, C>::constant(power(u.at[0], constant.at[0]));
  constexpr double most_multiplied = 1024;
  const double n = exponent.lower;
  if (n == exponent.upper && n == std::nearbyint(n) && std::abs(n) <= most_multiplied && n != 0) {
    const TaylorEnclosure<N, C> raised = whole_power(u, static_cast<int>(std::abs(n)));
    return n > 0 ? raised : TaylorEnclosure<N, C>::literal(1.0) / raised;
  }
  return both<N, C>(N + 1, u.reach, [&](auto& w, const auto& row) {
    using T = std::decay_t<decltype(w[0])>;
    const auto& a = row(u);
    const T& p = row(constant)[0];
    w[0] = power(a[0], p);
    for (std::size_t k = 1; k <= N; ++k) {  // w' u = p u' w
      T sum(0.0);
      for (std::size_t j = 1; j <= k && j < u.terms; ++j) {
        const T factor = p * T(static_cast<double>(j)) - T(static_cast<double>(k - j));
        const T term = factor * times(a[j], w[k - j]);
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

template struct TaylorEnclosure<curvature_order>;
template struct TaylorEnclosure<quadrature_order, Ball>;

template Curvature operator+(const Curvature&, const Curvature&);
template Curvature operator*(const Curvature&, const Curvature&);
template Curvature operator/(const Curvature&, const Curvature&);
template Curvature square(const Curvature&);
template Curvature sqrt(const Curvature&);
template Curvature sin(const Curvature&);
template Curvature cos(const Curvature&);
template Curvature power(const Curvature&, const Curvature&);
template Curvature evaluate(Function, const Curvature&);
template std::pair<Curvature, Curvature> sine_cosine(const Curvature&);

template FineSeries operator+(const FineSeries&, const FineSeries&);
template FineSeries operator*(const FineSeries&, const FineSeries&);
template FineSeries operator/(const FineSeries&, const FineSeries&);
template FineSeries square(const FineSeries&);
template FineSeries sqrt(const FineSeries&);
template FineSeries sin(const FineSeries&);
template FineSeries cos(const FineSeries&);
template FineSeries power(const FineSeries&, const FineSeries&);
template FineSeries evaluate(Function, const FineSeries&);
template std::pair<FineSeries, FineSeries> sine_cosine(const FineSeries&);

}  // namespace qdot
