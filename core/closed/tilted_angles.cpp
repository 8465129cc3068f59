#include "core/closed/tilted_angles.hpp"

#include "core/closed/exact_roots.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

struct Wave {
  Expression c0, c1, c2;
};

/// Of 1, cos(x) and sin(x); none where x stands in anything else.
std::optional<Wave> wave_in(const Expression& e, const Expression& x) {
  Graph& graph = e.graph();
  const Expression u = graph.symbol("cosine"), v = graph.symbol("sine");
  const std::vector<Replacement> named{{cos(x), u}, {sin(x), v}};
  const Polynomial above = with_single_angles(graph, rational_function(e).above);
  const Expression by_names = substitute(to_expression(graph, above), named);
  const Expression c1 = differentiate(by_names, u), c2 = differentiate(by_names, v);
  const Expression c0 = expand(by_names - c1 * u - c2 * v);
  for (const Expression& c : {c0, c1, c2}) {
    if (depends_on(c, x) || depends_on(c, u) || depends_on(c, v)) return std::nullopt;
  }
  if (c1.is_zero() || c2.is_zero()) return std::nullopt;
  return Wave{c0, c1, c2};
}

/// y where c2/c1 = tan(y) with an angle that is there, else the arc of that quotient.
Expression axis_of(const Wave& wave, const SignOf& sign) {
  Graph& graph = wave.c1.graph();
  for (const Expression& y : trigonometric_arguments(graph, multiplied_out(wave.c2))) {
    if (rational_function(wave.c1 * sin(y) - wave.c2 * cos(y)).is_zero()) return y;
  }
  return graph.call(Function::atan, shortest_quotient(wave.c2, wave.c1, sign));
}

}  // namespace

std::vector<Expression> tilted_angles(const Expression& e, const Expression& x,
                                      const std::optional<Expression>& x0, const ExactValues& values) {
  const auto wave = wave_in(e, x);
  if (!wave) return {};
  Graph& graph = e.graph();
  const SignOf sign = values.sign_of();
  const Expression axis = axis_of(*wave, sign);
  std::vector<Expression> found;
  if (x0) found.push_back(Number(2) * axis - *x0);
  const Expression square = expand(wave->c1 * wave->c1 + wave->c2 * wave->c2);
  for (const Expression& size : roots_of(-square, graph.number(0), graph.number(1), sign)) {
    const Expression away = graph.call(Function::acos, shortest_quotient(wave->c0, size, sign));
    found.insert(found.end(), {axis + away, axis - away});
  }
  return found;
}

}  // namespace qdot
