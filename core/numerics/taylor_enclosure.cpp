#include "core/numerics/taylor_enclosure.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

template <std::size_t N>
using Series = std::array<Interval, N + 1>;

/// 1 x would be rounded once more.
Interval times(const Interval& a, const Interval& b) {
  if (a.lower == 1 && a.upper == 1) return b;
  return b.lower == 1 && b.upper == 1 ? a : a * b;
}

/// A sum that is not rounded where it has one term.
class Sum {
 public:
  void add(const Interval& term) {
    total_ = empty_ ? term : total_ + term;
    empty_ = false;
  }
  [[nodiscard]] const Interval& total() const { return total_; }
  [[nodiscard]] bool is_empty() const { return empty_; }

 private:
  Interval total_{0};
  bool empty_{true};
};

/// f_k(X) by the mean value theorem, from the highest order down.
template <std::size_t N>
void tighten(TaylorEnclosure<N>& w) {
  if (w.terms == 1 || w.reach.width() == 0) return;
  for (std::size_t k = std::min(N, w.terms - 1); k-- > 0;) {
    const Interval change = Interval(static_cast<double>(k + 1)) * w.over[k + 1] * w.reach;
    w.over[k] = intersection(w.over[k], w.at[k] + change);
  }
}

/// Both rows of the result by the same recurrence.
template <std::size_t N, class Recurrence>
TaylorEnclosure<N> both(std::size_t terms, const Interval& reach, const Recurrence& recurrence) {
  TaylorEnclosure<N> w;
  w.terms = std::min(terms, N + 1);
  w.reach = reach;
  recurrence(w.at, [](const TaylorEnclosure<N>& u) -> const Series<N>& { return u.at; });
  recurrence(w.over, [](const TaylorEnclosure<N>& u) -> const Series<N>& { return u.over; });
  tighten(w);
  return w;
}

/// That of the one that is not constant.
template <std::size_t N>
const Interval& reach_of(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& v) {
  return u.terms > 1 ? u.reach : v.reach;
}

/// sum_j v_j w_{k-j} over j = first .. last, as far as v and w have terms.
template <std::size_t N>
Sum convolution(const Series<N>& v, std::size_t v_terms, const Series<N>& w, std::size_t w_terms,
                std::size_t k, std::size_t first, std::size_t last) {
  Sum sum;
  for (std::size_t j = first; j <= last && j < v_terms; ++j) {
    if (k - j < w_terms) sum.add(times(v[j], w[k - j]));
  }
  return sum;
}

/// sum_{j=1}^{k} j u_j v_{k-j} / k: the coefficient k of the integral of u' v.
template <std::size_t N>
Interval integrated(const Series<N>& u, std::size_t u_terms, const Series<N>& v, std::size_t k) {
  Sum sum;
  for (std::size_t j = 1; j <= k && j < u_terms; ++j) {
    sum.add(times(Interval(static_cast<double>(j)), times(u[j], v[k - j])));
  }
  return sum.is_empty() ? Interval(0) : sum.total() / Interval(static_cast<double>(k));
}

/// u_1^k / k! times the k-th derivative, which `derivative(k)` gives: of a function of a linear argument.
template <std::size_t N, class Derivative>
void of_linear(Series<N>& w, const Interval& u_1, const Derivative& derivative) {
  Interval factor(1);
  for (std::size_t k = 0; k <= N; ++k) {
    if (k > 0) factor = times(factor, u_1) / Interval(static_cast<double>(k));
    w[k] = times(factor, derivative(k));
  }
}

/// sin(u + phase pi/2).
template <std::size_t N>
TaylorEnclosure<N> wave(const TaylorEnclosure<N>& u, std::size_t phase) {
  return both<N>(u.terms == 1 ? 1 : N + 1, u.reach, [&](Series<N>& w, const auto& row) {
    const Series<N>& a = row(u);
    const Interval s = sin(a[0]), c = cos(a[0]);
    const Interval turned[4]{s, c, -s, -c};
    if (u.terms == 1) {
      w[0] = turned[phase];
    } else if (u.terms == 2) {
      of_linear<N>(w, a[1], [&](std::size_t k) { return turned[(k + phase) % 4]; });
    } else {
      Series<N> sine, cosine;
      sine[0] = s;
      cosine[0] = c;
      for (std::size_t k = 1; k <= N; ++k) {
        sine[k] = integrated<N>(a, u.terms, cosine, k);
        cosine[k] = -integrated<N>(a, u.terms, sine, k);
      }
      w = phase == 0 ? sine : cosine;
    }
  });
}

template <std::size_t N>
TaylorEnclosure<N> exponential(const TaylorEnclosure<N>& u) {
  return both<N>(u.terms == 1 ? 1 : N + 1, u.reach, [&](Series<N>& w, const auto& row) {
    const Series<N>& a = row(u);
    w[0] = evaluate(Function::exp, a[0]);
    if (u.terms == 2) {
      const Interval value = w[0];
      of_linear<N>(w, a[1], [&](std::size_t) { return value; });
    } else if (u.terms > 2) {
      for (std::size_t k = 1; k <= N; ++k) w[k] = integrated<N>(a, u.terms, w, k);
    }
  });
}

/// sinh (0) and cosh (1) are each other's derivatives.
template <std::size_t N>
TaylorEnclosure<N> hyperbolic(const TaylorEnclosure<N>& u, std::size_t which) {
  return both<N>(u.terms == 1 ? 1 : N + 1, u.reach, [&](Series<N>& w, const auto& row) {
    const Series<N>& a = row(u);
    Series<N> pair[2];
    pair[0][0] = evaluate(Function::sinh, a[0]);
    pair[1][0] = evaluate(Function::cosh, a[0]);
    for (std::size_t k = 1; k <= N && u.terms > 1; ++k) {
      const Interval odd = integrated<N>(a, u.terms, pair[1], k);
      pair[1][k] = integrated<N>(a, u.terms, pair[0], k);
      pair[0][k] = odd;
    }
    w = pair[which];
  });
}

/// f(u) of which f(u_0) is known, and the series of f'(u).
template <std::size_t N>
TaylorEnclosure<N> from_derivative(Function function, const TaylorEnclosure<N>& u,
                                   const TaylorEnclosure<N>& derivative) {
  return both<N>(N + 1, u.reach, [&](Series<N>& w, const auto& row) {
    w[0] = evaluate(function, row(u)[0]);
    for (std::size_t k = 1; k <= N; ++k) w[k] = integrated<N>(row(u), u.terms, row(derivative), k);
  });
}

/// w' = (1 - w^2) u'.
template <std::size_t N>
TaylorEnclosure<N> hyperbolic_tangent(const TaylorEnclosure<N>& u) {
  return both<N>(N + 1, u.reach, [&](Series<N>& w, const auto& row) {
    w[0] = evaluate(Function::tanh, row(u)[0]);
    Series<N> slope;
    const Interval inverse = Interval(1) / evaluate(Function::cosh, row(u)[0]);
    slope[0] = intersection(Interval(1) - square(w[0]), square(inverse));
    for (std::size_t k = 1; k <= N; ++k) {
      w[k] = integrated<N>(row(u), u.terms, slope, k);
      slope[k] = -convolution<N>(w, k + 1, w, k + 1, k, 0, k).total();
    }
  });
}

/// |u| and sign u: by their side, which is that of the whole piece.
template <std::size_t N>
TaylorEnclosure<N> sided(Function function, const TaylorEnclosure<N>& u) {
  const Interval& range = u.over[0];
  const bool bends = function == Function::abs;
  const bool above = range.lower > 0 || (bends && range.lower == 0 && range.upper > 0);
  const bool below = range.upper < 0 || (bends && range.upper == 0 && range.lower < 0);
  if (above || below) {
    if (!bends) return TaylorEnclosure<N>::constant(above ? 1.0 : -1.0);
    return above ? u : TaylorEnclosure<N>::literal(-1) * u;
  }
  return both<N>(N + 1, u.reach, [&](Series<N>& w, const auto& row) {
    w.fill(Interval::whole());
    w[0] = evaluate(function, row(u)[0]);
    if (bends) w[1] = Interval(-1, 1) * row(u)[1];
  });
}

/// By products.
template <std::size_t N>
TaylorEnclosure<N> whole_power(const TaylorEnclosure<N>& u, int exponent) {
  TaylorEnclosure<N> result = u;
  TaylorEnclosure<N> factor = u;
  bool first = true;
  for (int e = exponent; e > 0; e /= 2) {
    if (e % 2 == 1) {
      result = first ? factor : result * factor;
      first = false;
    }
    if (e > 1) factor = square(factor);
  }
  return result;
}

}  // namespace

template <std::size_t N>
TaylorEnclosure<N> TaylorEnclosure<N>::constant(const Interval& value) {
  TaylorEnclosure<N> result;
  result.at[0] = result.over[0] = value;
  return result;
}

template <std::size_t N>
TaylorEnclosure<N> TaylorEnclosure<N>::variable(const Interval& centre, const Interval& piece) {
  TaylorEnclosure<N> result;
  result.at[0] = centre;
  result.over[0] = piece;
  result.at[1] = result.over[1] = 1;
  result.terms = 2;
  result.reach = piece - centre;
  return result;
}

template <std::size_t N>
TaylorEnclosure<N> operator+(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& v) {
  return both<N>(std::max(u.terms, v.terms), reach_of(u, v), [&](Series<N>& w, const auto& row) {
    for (std::size_t k = 0; k <= N; ++k) {
      w[k] = k >= u.terms ? row(v)[k] : k >= v.terms ? row(u)[k] : row(u)[k] + row(v)[k];
    }
  });
}

template <std::size_t N>
TaylorEnclosure<N> operator*(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& v) {
  const std::size_t terms = std::min(u.terms + v.terms - 1, N + 1);
  return both<N>(terms, reach_of(u, v), [&](Series<N>& w, const auto& row) {
    for (std::size_t k = 0; k < terms; ++k) {
      w[k] = convolution<N>(row(u), u.terms, row(v), v.terms, k, 0, k).total();
    }
  });
}

template <std::size_t N>
TaylorEnclosure<N> operator/(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& v) {
  const std::size_t terms = v.terms == 1 ? u.terms : N + 1;
  return both<N>(terms, reach_of(u, v), [&](Series<N>& w, const auto& row) {
    for (std::size_t k = 0; k < terms; ++k) {
      const Sum known = convolution<N>(row(v), v.terms, w, terms, k, 1, k);
      const Interval above = known.is_empty() ? row(u)[k] : row(u)[k] - known.total();
      w[k] = above / row(v)[0];
    }
  });
}

template <std::size_t N>
TaylorEnclosure<N> square(const TaylorEnclosure<N>& u) {
  const std::size_t terms = std::min(2 * u.terms - 1, N + 1);
  return both<N>(terms, u.reach, [&](Series<N>& w, const auto& row) {
    const Series<N>& a = row(u);
    for (std::size_t k = 0; k < terms; ++k) {
      Sum sum;
      for (std::size_t j = 0; 2 * j < k; ++j) {
        if (j < u.terms && k - j < u.terms) sum.add(Interval(2) * times(a[j], a[k - j]));
      }
      if (k % 2 == 0 && k / 2 < u.terms) sum.add(square(a[k / 2]));
      w[k] = sum.total();
    }
  });
}

template <std::size_t N>
TaylorEnclosure<N> sqrt(const TaylorEnclosure<N>& u) {
  const std::size_t terms = u.terms == 1 ? 1 : N + 1;
  return both<N>(terms, u.reach, [&](Series<N>& w, const auto& row) {
    w[0] = sqrt(row(u)[0]);
    for (std::size_t k = 1; k < terms; ++k) {
      const Sum known = convolution<N>(w, terms, w, terms, k, 1, k - 1);
      const Interval above = known.is_empty() ? row(u)[k] : row(u)[k] - known.total();
      w[k] = above / (Interval(2) * w[0]);
    }
  });
}

template <std::size_t N>
TaylorEnclosure<N> sin(const TaylorEnclosure<N>& u) {
  return wave(u, 0);
}
template <std::size_t N>
TaylorEnclosure<N> cos(const TaylorEnclosure<N>& u) {
  return wave(u, 1);
}

template <std::size_t N>
TaylorEnclosure<N> power(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& constant) {
  const Interval& exponent = constant.at[0];
  if (u.terms == 1) return TaylorEnclosure<N>::constant(power(u.at[0], exponent));
  constexpr double most_multiplied = 1024;
  const double n = exponent.lower;
  if (n == exponent.upper && n == std::nearbyint(n) && std::abs(n) <= most_multiplied && n != 0) {
    const TaylorEnclosure<N> raised = whole_power(u, static_cast<int>(std::abs(n)));
    return n > 0 ? raised : TaylorEnclosure<N>::literal(1.0) / raised;
  }
  return both<N>(N + 1, u.reach, [&](Series<N>& w, const auto& row) {
    const Series<N>& a = row(u);
    w[0] = power(a[0], exponent);
    for (std::size_t k = 1; k <= N; ++k) {  // w' u = exponent u' w
      Sum sum;
      for (std::size_t j = 1; j <= k && j < u.terms; ++j) {
        const Interval factor =
            exponent * Interval(static_cast<double>(j)) - Interval(static_cast<double>(k - j));
        sum.add(factor * times(a[j], w[k - j]));
      }
      w[k] = sum.total() / (Interval(static_cast<double>(k)) * a[0]);
    }
  });
}

template <std::size_t N>
TaylorEnclosure<N> evaluate(Function function, const TaylorEnclosure<N>& u) {
  using Enclosure = TaylorEnclosure<N>;
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
template struct TaylorEnclosure<quadrature_order>;

using Curved = TaylorEnclosure<curvature_order>;
using Fine = TaylorEnclosure<quadrature_order>;

template Curved operator+(const Curved&, const Curved&);
template Curved operator*(const Curved&, const Curved&);
template Curved operator/(const Curved&, const Curved&);
template Curved square(const Curved&);
template Curved sqrt(const Curved&);
template Curved sin(const Curved&);
template Curved cos(const Curved&);
template Curved power(const Curved&, const Curved&);
template Curved evaluate(Function, const Curved&);

template Fine operator+(const Fine&, const Fine&);
template Fine operator*(const Fine&, const Fine&);
template Fine operator/(const Fine&, const Fine&);
template Fine square(const Fine&);
template Fine sqrt(const Fine&);
template Fine sin(const Fine&);
template Fine cos(const Fine&);
template Fine power(const Fine&, const Fine&);
template Fine evaluate(Function, const Fine&);

}  // namespace qdot
