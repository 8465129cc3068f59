#include "core/closed/cosine_roots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "core/numerics/function.hpp"

namespace qdot {
namespace {

using Numbers = std::vector<Number>;  ///< coefficients of 1, x, x^2, ...

/// j < N/2 without common divisors with N.
std::vector<int> coprime_below_half(int n) {
  std::vector<int> found;
  for (int j = 1; 2 * j < n; ++j) {
    if (std::gcd(j, n) == 1) found.push_back(j);
  }
  return found;
}

double twice_cosine(int j, int n) { return 2 * evaluate(Function::cos, 2 * std::numbers::pi * j / n); }

/// With the roots 2 cos(2 pi j/N): its coefficients are whole numbers.
Numbers polynomial_of_cosines(int n) {
  std::vector<double> c{1};
  for (const int j : coprime_below_half(n)) {
    const double root = twice_cosine(j, n);
    c.push_back(0);
    for (std::size_t k = c.size(); k-- > 0;) c[k] = (k > 0 ? c[k - 1] : 0) - root * c[k];
  }
  Numbers result;
  for (const double x : c) result.emplace_back(static_cast<std::int64_t>(std::llround(x)));
  return result;
}

/// f((x - p)/q).
Numbers moved(const Numbers& f, const Number& p, const Number& q) {
  Numbers result{Number(0)};
  for (std::size_t k = f.size(); k-- > 0;) {
    Numbers next(result.size() + 1, Number(0));
    for (std::size_t i = 0; i < result.size(); ++i) {
      next[i + 1] = next[i + 1] + result[i] / q;
      next[i] = next[i] - result[i] * p / q;
    }
    next[0] = next[0] + f[k];
    result = std::move(next);
  }
  while (result.size() > 1 && result.back().is_zero()) result.pop_back();
  return result;
}

/// a/b where nothing is left.
std::optional<Numbers> quotient(Numbers a, const Numbers& b) {
  if (a.size() < b.size()) return std::nullopt;
  Numbers result(a.size() - b.size() + 1, Number(0));
  for (std::size_t k = result.size(); k-- > 0;) {
    result[k] = a[k + b.size() - 1] / b.back();
    for (std::size_t i = 0; i < b.size(); ++i) a[k + i] = a[k + i] - result[k] * b[i];
  }
  if (std::ranges::any_of(a, [](const Number& left) { return !left.is_zero(); })) return std::nullopt;
  return result;
}

/// Whether x may be a root: the terms cancel.
bool is_nearly_root(const Numbers& c, double x) {
  double sum = 0, size = 0;
  for (std::size_t k = c.size(); k-- > 0;) {
    sum = sum * x + c[k].value();
    size = size * std::abs(x) + std::abs(c[k].value());
  }
  return std::abs(sum) <= 1e-9 * size;
}

struct Shape {
  int n;
  Number p, q;
};

std::optional<Shape> shape_in(const Numbers& c) {
  constexpr int largest = 60;
  for (int n = 7; n <= largest; ++n) {
    const std::size_t degree = coprime_below_half(n).size();
    if (degree < 3 || degree + 1 > c.size()) continue;
    for (const Number& q : {Number(1), Number(2), Number::ratio(1, 2), Number(3), Number(4)}) {
      for (const int share : {2, 0, 1, 3, 4}) {
        const Number p = Number(share) * q;
        if (is_nearly_root(c, p.value() + q.value() * twice_cosine(1, n))) return Shape{n, p, q};
      }
    }
  }
  return std::nullopt;
}

Expression root(Graph& graph, const Shape& shape, int j) {
  const Expression pi = graph.symbol("pi");
  if (shape.p == Number(2) * shape.q) {
    const Expression sine = sin(Number::ratio(shape.n - 2 * j, 2 * shape.n) * pi);
    return Number(4) * shape.q * pow(sine, Number(2));
  }
  return graph.number(shape.p) + Number(2) * shape.q * cos(Number::ratio(2 * j, shape.n) * pi);
}

}  // namespace

std::vector<Expression> cosine_roots(Graph& graph, std::vector<Number> c) {
  std::vector<Expression> found;
  while (c.size() > 3) {
    const auto shape = shape_in(c);
    if (!shape) break;
    auto rest = quotient(c, moved(polynomial_of_cosines(shape->n), shape->p, shape->q));
    if (!rest) break;
    for (const int j : coprime_below_half(shape->n)) found.push_back(root(graph, *shape, j));
    c = *std::move(rest);
  }
  return found;
}

}  // namespace qdot
