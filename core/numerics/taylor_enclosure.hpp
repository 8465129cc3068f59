#pragma once
// Taylor coefficients f^(k)(c)/k! of the functions on a tape, k = 0 .. N, enclosed twice: at a centre c, and
// over a whole piece X of the axis that contains c. Then, for every x in X and every n <= N,
//
//   f(x) = sum_{k<n} f_k(c) (x - c)^k + f_n(xi) (x - c)^n,   f_n(xi) in the coefficient n over X,
//
// which is a proven statement about the piece and not about points of it. What a formula says of f_k over X
// is narrowed by the mean value theorem, f_k(c) + (k + 1) f_{k+1}(X) (X - c), so that the expanded form of (x
// - b)^2 says no less than (x - b)^2 where the piece is short. Where |u| bends, or sign(u) jumps, inside the
// piece, the coefficients that do not exist are the whole line; a kink at an end of the piece is none, for
// the function is then smooth on all of it. Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis
// (2009), chapter 9; Griewank, Walther, Evaluating Derivatives (2008), table 13.1 (recurrences).

#include <array>
#include <cstddef>
#include <utility>

#include "core/numerics/ball.hpp"
#include "core/numerics/interval.hpp"

namespace qdot {

template <std::size_t N, class Centre = Interval>
struct TaylorEnclosure {
  std::array<Centre, N + 1> at;      ///< f_k(c)
  std::array<Interval, N + 1> over;  ///< all of f_k(x), x in X
  std::size_t terms = 1;             ///< coefficients from here on are 0; 1: a constant, 2: linear in x
  Interval reach{0};                 ///< X - c

  /// A literal of a tape, as Interval::literal takes it.
  [[nodiscard]] static TaylorEnclosure literal(const Real& value) { return constant(Centre::literal(value)); }
  [[nodiscard]] static TaylorEnclosure constant(const Centre& value);
  /// A function of which nothing is known.
  [[nodiscard]] static TaylorEnclosure undefined();
  /// x itself.
  [[nodiscard]] static TaylorEnclosure variable(const Centre& centre, const Interval& piece);
};

template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> operator+(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v);
template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> operator*(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v);
template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> operator/(const TaylorEnclosure<N, C>& u, const TaylorEnclosure<N, C>& v);
template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> square(const TaylorEnclosure<N, C>& u);
template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> sqrt(const TaylorEnclosure<N, C>& u);
template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> sin(const TaylorEnclosure<N, C>& u);
template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> cos(const TaylorEnclosure<N, C>& u);
template <std::size_t N, class C>
[[nodiscard]] std::pair<TaylorEnclosure<N, C>, TaylorEnclosure<N, C>> sine_cosine(
    const TaylorEnclosure<N, C>& u);
/// u^exponent for u > 0 or a whole exponent, which is a constant.
template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> power(const TaylorEnclosure<N, C>& u,
                                          const TaylorEnclosure<N, C>& exponent);
template <std::size_t N, class C>
[[nodiscard]] TaylorEnclosure<N, C> evaluate(Function function, const TaylorEnclosure<N, C>& u);

/// The orders there are: value, slope and curvature; and what quadrature takes.
inline constexpr std::size_t curvature_order = 2;
inline constexpr std::size_t quadrature_order = 16;
using Curvature = TaylorEnclosure<curvature_order>;
using FineSeries = TaylorEnclosure<quadrature_order, Ball>;
extern template struct TaylorEnclosure<curvature_order>;
extern template struct TaylorEnclosure<quadrature_order, Ball>;

}  // namespace qdot
