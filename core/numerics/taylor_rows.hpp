#pragma once
// Rows of Taylor coefficients, for the recurrences of core/numerics/taylor_enclosure.hpp: sums of products of
// two rows, where what is exactly zero stays so and what is known exactly is not rounded.
// Source: Griewank, Walther, Evaluating Derivatives (2008), table 13.1.

#include <algorithm>

#include "core/numerics/product_sum.hpp"
#include "core/numerics/taylor_enclosure.hpp"

namespace qdot::rows {

inline Interval enclosed(const Interval& x) { return x; }
inline Interval enclosed(const Ball& x) { return x.interval(); }

/// 1 x would be rounded once more.
inline Interval times(const Interval& a, const Interval& b) {
  if (a.lower == 1 && a.upper == 1) return b;
  return b.lower == 1 && b.upper == 1 ? a : a * b;
}
inline Ball times(const Ball& a, const Ball& b) { return a * b; }

inline bool is_nothing(const Interval& x) { return x.lower == 0 && x.upper == 0; }
inline bool is_nothing(const Ball& x) { return x.is_zero(); }
inline bool is_unknown(const Interval& x) { return !x.is_finite(); }
inline bool is_unknown(const Ball& x) { return !x.is_finite(); }

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

}  // namespace qdot::rows
