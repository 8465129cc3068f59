#pragma once
// Tapes of one formula, for the tests of Taylor series.

#include <string>
#include <vector>

#include "core/compile/tape_builder.hpp"
#include "core/expr/parse.hpp"

namespace qdot::test {

/// f(t, q, q_dot)
inline CompiledFunction function_of(const std::string& formula) {
  Graph graph;
  const Expression t = graph.symbol("t");
  const std::vector<Expression> variables{graph.symbol("q"), graph.symbol("q_dot")};
  const std::vector<std::string> names{"t", "q", "q_dot"};
  TapeBuilder builder(graph, {}, t, variables);
  builder.output(parse(formula, graph, names));
  return builder.finish();
}

}  // namespace qdot::test
