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

#include "core/numerics/interval.hpp"

namespace qdot {

template <std::size_t N>
struct TaylorEnclosure {
  using Coefficients = std::array<Interval, N + 1>;
  Coefficients at;        ///< f_k(c)
  Coefficients over;      ///< all of f_k(x), x in X
  std::size_t terms = 1;  ///< coefficients from here on are 0; 1: a constant, 2: linear in x
  Interval reach{0};      ///< X - c

  /// A literal of a tape, as Interval::literal takes it.
  [[nodiscard]] static TaylorEnclosure literal(const Real& value) {
    return constant(Interval::literal(value));
  }
  [[nodiscard]] static TaylorEnclosure constant(const Interval& value);
  /// x itself.
  [[nodiscard]] static TaylorEnclosure variable(const Interval& centre, const Interval& piece);
};

template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> operator+(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& v);
template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> operator*(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& v);
template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> operator/(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& v);
template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> square(const TaylorEnclosure<N>& u);
template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> sqrt(const TaylorEnclosure<N>& u);
template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> sin(const TaylorEnclosure<N>& u);
template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> cos(const TaylorEnclosure<N>& u);
/// u^exponent for u > 0 or a whole exponent, which is a constant.
template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> power(const TaylorEnclosure<N>& u, const TaylorEnclosure<N>& exponent);
template <std::size_t N>
[[nodiscard]] TaylorEnclosure<N> evaluate(Function function, const TaylorEnclosure<N>& u);

/// The orders there are: value, slope and curvature; and what quadrature takes.
inline constexpr std::size_t curvature_order = 2;
inline constexpr std::size_t quadrature_order = 16;
extern template struct TaylorEnclosure<curvature_order>;
extern template struct TaylorEnclosure<quadrature_order>;

}  // namespace qdot
