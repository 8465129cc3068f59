// Sums, products, quotients, squares and roots (core/numerics/taylor_enclosure.hpp).

#include "core/numerics/taylor_enclosure.hpp"

#include "core/numerics/taylor_rows.hpp"

namespace qdot {

template <std::size_t N, class C>
TaylorEnclosure<N, C> TaylorEnclosure<N, C>::constant(const C& value) {
  TaylorEnclosure<N, C> result;
  result.at[0] = value;
  result.over[0] = rows::enclosed(value);
  return result;
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> TaylorEnclosure<N, C>::undefined() {
  TaylorEnclosure<N, C> result;
  result.at.fill(C(1.0) / C(0.0));
  result.over.fill(Interval::whole());
  result.terms = N + 1;
  result.reach = Interval::whole();
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
  result.reach = piece - rows::enclosed(centre);
  return result;
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> operator+(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v) {
  return rows::both<N, C>(std::max(u.terms, v.terms), rows::reach_of(u, v), [&](auto& w, const auto& row) {
    for (std::size_t k = 0; k <= N; ++k) {
      w[k] = k >= u.terms ? row(v)[k] : k >= v.terms ? row(u)[k] : row(u)[k] + row(v)[k];
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> operator*(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v) {
  const std::size_t terms = std::min(u.terms + v.terms - 1, N + 1);
  return rows::both<N, C>(terms, rows::reach_of(u, v), [&](auto& w, const auto& row) {
    for (std::size_t k = 0; k < terms; ++k) {
      w[k] = rows::convolution(row(u), u.terms, row(v), v.terms, k, 0, k);
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> operator/(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v) {
  const std::size_t terms = v.terms == 1 ? u.terms : N + 1;
  return rows::both<N, C>(terms, rows::reach_of(u, v), [&](auto& w, const auto& row) {
    for (std::size_t k = 0; k < terms; ++k) {
      const auto known = rows::convolution(row(v), v.terms, w, terms, k, 1, k);
      w[k] = rows::difference(row(u)[k], known) / row(v)[0];
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> square(const TaylorEnclosure<N, C>& u) {
  const std::size_t terms = std::min(2 * u.terms - 1, N + 1);
  return rows::both<N, C>(terms, u.reach, [&](auto& w, const auto& row) {
    using T = std::decay_t<decltype(w[0])>;
    const auto& a = row(u);
    for (std::size_t k = 0; k < terms; ++k) {
      const std::size_t before = (k + 1) / 2;  // pairs j, k - j with j < k - j
      const T pairs = before == 0 ? T(0.0) : rows::convolution(a, u.terms, a, u.terms, k, 0, before - 1);
      const T both_ways = pairs + pairs;
      if (k % 2 != 0 || k / 2 >= u.terms) {
        w[k] = both_ways;
      } else {
        w[k] = rows::is_nothing(pairs) ? square(a[k / 2]) : both_ways + square(a[k / 2]);
      }
    }
  });
}

template <std::size_t N, class C>
TaylorEnclosure<N, C> sqrt(const TaylorEnclosure<N, C>& u) {
  const std::size_t terms = u.terms == 1 ? 1 : N + 1;
  return rows::both<N, C>(terms, u.reach, [&](auto& w, const auto& row) {
    w[0] = sqrt(row(u)[0]);
    const auto twice = w[0] + w[0];
    for (std::size_t k = 1; k < terms; ++k) {
      const auto known = rows::convolution(w, terms, w, terms, k, 1, k - 1);
      w[k] = rows::difference(row(u)[k], known) / twice;
    }
  });
}

template struct TaylorEnclosure<curvature_order>;
template struct TaylorEnclosure<quadrature_order, Ball>;

template Curvature operator+(const Curvature&, const Curvature&);
template Curvature operator*(const Curvature&, const Curvature&);
template Curvature operator/(const Curvature&, const Curvature&);
template Curvature square(const Curvature&);
template Curvature sqrt(const Curvature&);

template FineSeries operator+(const FineSeries&, const FineSeries&);
template FineSeries operator*(const FineSeries&, const FineSeries&);
template FineSeries operator/(const FineSeries&, const FineSeries&);
template FineSeries square(const FineSeries&);
template FineSeries sqrt(const FineSeries&);

}  // namespace qdot
