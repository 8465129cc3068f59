#include "core/closed/sine_squares.hpp"

#include <algorithm>
#include <vector>

#include "core/closed/taken_squares.hpp"
#include "core/expr/factored_form.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// Arguments u of cos(u) in squares and higher powers.
std::vector<Expression> angles_of_squares(const Expression& e) {
  Graph& graph = e.graph();
  std::vector<Expression> found;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    const auto* call = power == nullptr ? nullptr : std::get_if<Call>(&graph.node(power->base));
    if (call == nullptr || call->function != Function::cos || !power->exponent.is_integer()) continue;
    const Expression u(graph, call->argument);
    if (std::ranges::find(found, u) == found.end()) found.push_back(u);
  }
  return found;
}

}  // namespace

Expression with_sine_squares(const Expression& e, const SignOf& sign) {
  Graph& graph = e.graph();
  const std::vector<Expression> angles = angles_of_squares(e);
  if (angles.empty()) return e;
  const auto product_of = [&](Polynomial a) {
    for (const Expression& u : angles) a = without_cosine_squares(graph, a, u);
    return factored_form(graph, a);
  };
  const auto written = [&](const Expression& part) {
    const RationalFunction f = rational_function(part);
    return product_of(f.above) / product_of(f.below);
  };
  return written(with_half_powers(e, [&](const Expression& base, const Number& exponent) {
    const Expression root = positive_root(graph, rational_function(written(base)), sign);
    return std::optional(pow(root, exponent * Number(2)));
  }));
}

}  // namespace qdot
