#include "core/closed/even_ways.hpp"

#include <map>
#include <utility>

#include "core/closed/asked_of_turning.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/special_angles.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// Of the powers of u from the lowest on, and u where the way begins and in its middle.
struct EvenWay {
  std::vector<Expression> coefficients;
  Expression start, middle;
};

/// By powers of the base; none where x stands elsewhere.
std::optional<std::vector<Expression>> powers_of(const Polynomial& e, const Expression& base,
                                                 const Expression& x, int step) {
  constexpr int highest = 8;
  Graph& graph = x.graph();
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, number] : e) {
    const int power = exponent_of(monomial, base.id());
    const Monomial rest = times(monomial, base.id(), -power);
    if (power < 0 || power > highest || power % step != 0) return std::nullopt;
    if (depends_on(to_expression(graph, rest), x)) return std::nullopt;
    add(parts[power / step], rest, number);
  }
  if (parts.empty()) return std::nullopt;
  std::vector<Expression> coefficients;
  const int degree = parts.rbegin()->first;
  for (int k = 0; k <= degree; ++k) coefficients.push_back(to_expression(graph, parts[k]));
  return coefficients;
}

std::optional<EvenWay> even_way(const QuadratureProblem& problem, const Expression& x0) {
  Graph& graph = problem.x.graph();
  const Polynomial left = rational_function(problem.energy - problem.potential).above;
  if (auto c = powers_of(left, problem.x, problem.x, 2))
    return EvenWay{*std::move(c), pow(x0, Number(2)), graph.number(0)};
  const Expression cosine = graph.call(Function::cos, problem.x);
  if (auto c = powers_of(with_single_angles(graph, left), cosine, problem.x, 1))
    return EvenWay{*std::move(c), with_special_angles(graph.call(Function::cos, x0)), graph.number(1)};
  return std::nullopt;
}

/// Q: what (u - u0) leaves.
std::vector<Expression> quotient_of(const EvenWay& way) {
  std::vector<Expression> q{way.coefficients.back()};
  for (std::size_t k = way.coefficients.size() - 2; k > 0; --k)
    q.insert(q.begin(), way.coefficients[k] + q.front() * way.start);
  return q;
}

Expression polynomial_at(const std::vector<Expression>& q, const Expression& u) {
  Expression value = u.graph().number(0);
  for (std::size_t k = q.size(); k-- > 0;) value = q[k] + value * u;
  return value;
}

}  // namespace

void ask_about_hills(const QuadratureProblem& problem, const Expression& x0, const ExactValues& values,
                     AssumedSigns& signs) {
  const std::optional<EvenWay> way = even_way(problem, x0);
  if (!way || way->coefficients.size() < 3) return;
  std::vector<Expression> q = quotient_of(*way);
  const Expression there = polynomial_at(q, way->middle);
  const int side = values.value(there).value < 0 ? -1 : 1;
  for (Expression& each : q) each = Number(side) * each;
  signs.ask_one_of({Number(side) * there});
  if (q.size() == 3) {
    const Number inwards(values.value(way->middle - way->start).value < 0 ? -1 : 1);
    signs.ask_one_of({Number(4) * q[0] * q[2] - q[1] * q[1], inwards * (q[1] + Number(2) * q[2] * way->start),
                      -inwards * (q[1] + Number(2) * q[2] * way->middle)});
  } else if (q.size() > 3 && way->middle.is_zero()) {
    for (const Expression& each : q) signs.ask_one_of({each});
  }
}

}  // namespace qdot
