#include "core/steady/free_direction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/zeroness.hpp"

namespace qdot {
namespace {

constexpr double rounding = 1e-9;

bool is_near(double a, double b) { return std::abs(a - b) <= rounding * std::max(1.0, std::abs(b)); }

/// p/q near x with a small q.
std::optional<Number> short_fraction(double x) {
  constexpr std::int64_t largest_denominator = 60;
  for (std::int64_t q = 1; q <= largest_denominator; ++q) {
    const double p = std::round(x * static_cast<double>(q));
    if (is_near(p / static_cast<double>(q), x)) return Number::ratio(static_cast<std::int64_t>(p), q);
  }
  return std::nullopt;
}

/// What components are tried as first.
enum class Ratios { fractions, quotients };

class FreeDirection {
 public:
  FreeDirection(const Statics& statics, const std::vector<Ball>& constants)
      : statics_(statics), constants_(constants), graph_(*statics.reduction.graph) {}

  [[nodiscard]] bool contains(const std::vector<double>& v, Ratios tried) {
    std::vector<Expression> exact;
    for (const double entry : v) {
      std::optional<Expression> ratio =
          tried == Ratios::fractions ? fraction_near(entry) : quotient_near(entry);
      if (!ratio) ratio = tried == Ratios::fractions ? quotient_near(entry) : fraction_near(entry);
      if (!ratio) return false;
      exact.push_back(*ratio);
    }
    return std::ranges::all_of(statics_.rest,
                               [&](const Expression& force) { return is_constant_along(exact, force); });
  }

 private:
  [[nodiscard]] std::optional<Expression> fraction_near(double x) {
    const std::optional<Number> fraction = short_fraction(x);
    return fraction ? std::optional(graph_.number(*fraction)) : std::nullopt;
  }
  [[nodiscard]] std::optional<Expression> quotient_near(double x) {
    for (std::size_t a = 0; a < constants_.size(); ++a) {
      for (std::size_t b = 0; b < constants_.size(); ++b) {
        const double ratio = constants_[a].value() / constants_[b].value();
        if (a == b || !is_near(std::abs(ratio), std::abs(x))) continue;
        return Number(ratio * x < 0 ? -1 : 1) * (constant(a) / constant(b));
      }
    }
    return std::nullopt;
  }
  [[nodiscard]] Expression constant(std::size_t k) { return graph_.adopt(statics_.reduction.constants[k]); }

  [[nodiscard]] bool is_constant_along(const std::vector<Expression>& v, const Expression& force) {
    Expression slope = graph_.number(0);
    for (std::size_t j = 0; j < v.size(); ++j) {
      if (v[j].is_zero()) continue;
      slope = slope + v[j] * differentiate(graph_.adopt(force), graph_.adopt(statics_.reduction.x[j]));
    }
    return zeroness(slope) == Zeroness::zero;
  }

  const Statics& statics_;
  const std::vector<Ball>& constants_;
  Graph graph_;
};

}  // namespace

bool is_free(const Statics& statics, const std::vector<Ball>& constants, const Shape& v) {
  double largest = 0;
  for (const ComplexBall& entry : v) {
    const double x = entry.re.value();
    if (std::abs(x) > (1 + rounding) * std::abs(largest)) largest = x;
  }
  if (largest == 0 || statics.rest.empty()) return false;
  std::vector<double> ratios;
  for (const ComplexBall& entry : v) ratios.push_back(entry.re.value() / largest);
  try {
    FreeDirection direction(statics, constants);
    return direction.contains(ratios, Ratios::fractions) || direction.contains(ratios, Ratios::quotients);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return false;
  }
}

}  // namespace qdot
