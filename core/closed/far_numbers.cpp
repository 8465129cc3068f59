#include "core/closed/far_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/numerics/constants.hpp"
#include "core/numerics/function.hpp"

namespace qdot {

namespace {

double part_of_one(std::minstd_rand& random) {
  return static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
}

}  // namespace

double scaled_value(double value, double reach, const Domain& domain, std::minstd_rand& random) {
  const double u = part_of_one(random);
  const double x = value * power(reach, 2 * u - 1);
  return domain.contains(x) ? x : value;
}

double far_value(double value, const Domain& domain, std::minstd_rand& random) {
  const double u = part_of_one(random);
  const double size = power(12.0, 2 * u - 1), x = value < 0 ? -size : size;
  if (value == 0 || domain.contains(x)) return value == 0 ? 0 : x;
  const double lower = value > 0 ? std::max(domain.lower, 0.0) : domain.lower,
               upper = value < 0 ? std::min(domain.upper, 0.0) : domain.upper;
  if (std::isinf(upper)) return lower + size;
  return std::isinf(lower) ? upper - size : lower + (upper - lower) * u;
}

double far_angle(double value, const Domain& domain, std::minstd_rand& random) {
  const double u = part_of_one(random);
  const double x = value < 0 ? -4 * pi * u : 4 * pi * u;
  return value != 0 && domain.contains(x) ? x : value;
}

std::vector<Expression> angles_among(const std::vector<Expression>& symbols) {
  std::vector<Expression> angles;
  if (symbols.empty()) return angles;
  Graph& graph = symbols[0].graph();
  std::vector<NodeId> arguments;
  for (NodeId id = 0; id < graph.size(); ++id) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call != nullptr && (call->function == Function::sin || call->function == Function::cos ||
                            call->function == Function::tan))
      arguments.push_back(call->argument);
  }
  const std::vector<NodeId> inside = reachable(graph, arguments);
  std::ranges::copy_if(symbols, std::back_inserter(angles), [&](const Expression& symbol) {
    return std::ranges::find(inside, symbol.id()) != inside.end();
  });
  return angles;
}

}  // namespace qdot
