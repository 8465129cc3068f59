// An expression and its derivatives have on a tape the values that they have on the tree: both lie in the
// interval that encloses the tape's.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/work.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/simplify.hpp"
#include "core/numerics/interval.hpp"
#include "tests/fuzz/law.hpp"

namespace {

using namespace qdot;

constexpr std::array<double, 3> parameters{0.5, 9.81, 1.25};
constexpr std::array<std::array<double, 3>, 3> states{{{0.3, -1.5, 2}, {0, 0, 0}, {-2.25, 1e-3, 17}}};

struct Symbols {
  explicit Symbols(Graph& graph) {
    for (const char* name : {"m", "g", "l"}) constants.push_back(graph.symbol(name));
    for (const char* name : {"theta", "phi", "theta_dot"}) variables.push_back(graph.symbol(name));
  }
  [[nodiscard]] std::vector<Assignment> at(std::span<const double> state) const {
    std::vector<Assignment> values;
    for (std::size_t i = 0; i < constants.size(); ++i) values.emplace_back(constants[i], parameters[i]);
    for (std::size_t i = 0; i < variables.size(); ++i) values.emplace_back(variables[i], state[i]);
    return values;
  }
  std::vector<Expression> constants, variables;
};

void compare(Graph& graph, const Expression& e) {
  const Symbols symbols(graph);
  TapeBuilder builder(graph, symbols.constants, graph.symbol("t"), symbols.variables);
  builder.output(e);
  const CompiledFunction tape = builder.finish();
  Workspace workspace = tape.bind(parameters);
  const std::vector<Interval> bound(parameters.begin(), parameters.end());
  TapeEvaluator<Interval> enclosing(tape, bound);
  for (const auto& state : states) {
    double value{};
    if (tape.evaluate(0, state, workspace, {&value, 1}) != Evaluation::ok) continue;
    const std::vector<Interval> place(state.begin(), state.end());
    Interval enclosure;
    enclosing(place, {&enclosure, 1});
    if (!enclosure.is_finite()) continue;
    fuzz::require(enclosure.contains(value), "the tape's value lies in its enclosure");
    const double tree = evaluate(e, symbols.at(state));
    // The tree adds in another order, so its own errors are like those that the enclosure bounds.
    const double tolerance = 8 * enclosure.radius() + 1e-300;
    fuzz::require(std::abs(tree - enclosure.middle()) <= tolerance, "the tree's value lies near it");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::string> names{"m", "g", "l", "theta", "phi", "theta_dot"};
  if (size > 400) return 0;  // derivatives of derivatives grow
  try {
    const WorkScope work(fuzz::algebra);
    Graph graph;
    const ParseResult result = parse_all(fuzz::text_of(data, size), graph, names);
    if (!result.expression) return 0;
    const Expression theta = graph.symbol("theta");
    const Expression first = differentiate(*result.expression, theta);
    const Expression second = differentiate(first, theta);
    for (const Expression& e : {*result.expression, first, second, simplify(first)}) compare(graph, e);
  } catch (const Error&) {  // too large to differentiate
  }
  return 0;
}
