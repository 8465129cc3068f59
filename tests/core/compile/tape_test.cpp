// A compiled tape gives what walking the tree gives.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/compile/tape_builder.hpp"
#include "core/expr/print/print.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/random_expression.hpp"
#include "tests/support/random_polynomial.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

/// Symbols of random expressions by their place on a tape.
struct Places {
  explicit Places(Graph& graph) {
    for (const char* name : {"m", "g", "l"}) parameters.push_back(graph.symbol(name));
    for (const char* name : {"theta", "phi", "theta_dot", "phi_ddot"})
      variables.push_back(graph.symbol(name));
  }
  std::vector<Expression> parameters, variables;
};

/// The value of e on a tape, NaN where it has none.
double on_tape(Graph& graph, const Places& places, const Expression& e, std::span<const double> parameters,
               std::span<const double> variables) {
  TapeBuilder builder(graph, places.parameters, graph.symbol("t"), places.variables);
  builder.output(e);
  const CompiledFunction function = builder.finish();
  Workspace workspace = function.bind(parameters);
  double value{};
  const Evaluation evaluation = function.evaluate(0.5, variables, workspace, {&value, 1});
  return evaluation == Evaluation::ok ? value : std::numeric_limits<double>::quiet_NaN();
}

TEST(Tape, GivesTheTreesValueOfRandomExpressions) {
  test::Random random(14);
  test::Ingredients ingredients;
  ingredients.functions = {Function::sin, Function::cos, Function::atan, Function::tanh, Function::exp};
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    Graph graph;
    const Places places(graph);
    const Expression e = test::random_expression(random, graph, 1 + i % 4, ingredients);
    std::vector<double> parameters, variables;
    std::vector<Assignment> values;
    for (const Expression& p : places.parameters)
      values.emplace_back(p, parameters.emplace_back(random.real(0.5, 2)));
    for (const Expression& x : places.variables)
      values.emplace_back(x, variables.emplace_back(random.real(-2, 2)));
    const double tree = evaluate(e, values);
    const double largest = test::largest_part(e, values);
    if (!std::isfinite(tree) || !(largest < 1e6)) continue;  // steep functions magnify the last bit
    const double tape = on_tape(graph, places, e, parameters, variables);
    EXPECT_NEAR(tape, tree, 1e-14 * (1 + largest * largest)) << print(e, Form::text);
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

TEST(Tape, HasNoValueWhereTheTreeHasNone) {
  Graph graph;
  const Places places(graph);
  const Expression theta = graph.symbol("theta");
  const std::vector<double> parameters{1, 1, 1}, at_zero{0, 1, 1, 1}, below{-1, 1, 1, 1};
  EXPECT_TRUE(std::isnan(on_tape(graph, places, graph.number(1) / theta, parameters, at_zero)));
  EXPECT_TRUE(std::isnan(on_tape(graph, places, sqrt(theta), parameters, below)));
  EXPECT_TRUE(std::isnan(on_tape(graph, places, graph.call(Function::log, theta), parameters, below)));
  EXPECT_TRUE(
      std::isnan(on_tape(graph, places, theta / graph.symbol("m"), std::vector<double>{0, 1, 1}, below)));
}

TEST(Tape, ComputesWhatParametersAloneDecideOnce) {
  Graph graph;
  const Places places(graph);
  const Expression m = graph.symbol("m"), g = graph.symbol("g"), theta = graph.symbol("theta");
  TapeBuilder builder(graph, places.parameters, graph.symbol("t"), places.variables);
  builder.output(graph.call(Function::exp, m * g) * theta);
  EXPECT_EQ(builder.finish().instructions().size(), 1u);
}

TEST(Tape, ComputesSharedPartsOnce) {
  Graph graph;
  const Places places(graph);
  const Expression u = graph.symbol("theta") - graph.symbol("phi");
  TapeBuilder builder(graph, places.parameters, graph.symbol("t"), places.variables);
  for (const Expression& e : {sin(u), cos(u), sin(u) * cos(u), sin(u)}) builder.output(e);
  EXPECT_EQ(builder.finish().instructions().size(), 3u);  // u, its sine and cosine together, their product
}

TEST(Tape, RefusesASymbolThatNobodyGives) {
  Graph graph;
  const Places places(graph);
  TapeBuilder builder(graph, places.parameters, graph.symbol("t"), places.variables);
  EXPECT_THROW(builder.output(graph.symbol("r")), Error);
}

/// M x = b for two and three unknowns that are coupled, and one that is not.
TEST(Tape, SolvesLinearSystems) {
  Graph graph;
  const Places places(graph);
  const auto x = [&](const char* name) { return graph.symbol(name); };
  const Expression zero = graph.number(0), one = graph.number(1);
  TapeBuilder builder(graph, places.parameters, graph.symbol("t"), places.variables);
  const auto columns =
      builder.solve({.matrix = {{x("m"), x("theta"), zero}, {x("theta"), x("g"), zero}, {zero, zero, x("l")}},
                     .determinant = {},
                     .right_hand_sides = {{one, x("phi"), x("theta_dot")}},
                     .unknowns = {}});
  for (const Slot slot : columns[0]) builder.output(slot);
  const CompiledFunction function = builder.finish();
  Workspace workspace = function.bind(std::vector<double>{2, 3, 4});
  std::vector<double> out(3);
  ASSERT_EQ(function.evaluate(0, std::vector<double>{1, 5, 8, 0}, workspace, out), Evaluation::ok);
  EXPECT_DOUBLE_EQ(out[0], (1 * 3 - 5 * 1) / 5.0);
  EXPECT_DOUBLE_EQ(out[1], (2 * 5 - 1 * 1) / 5.0);
  EXPECT_DOUBLE_EQ(out[2], 2);
  const double lost = std::sqrt(6.0);  // det = m g - theta^2 = 0 to round-off
  EXPECT_EQ(function.evaluate(0, std::vector<double>{lost, 5, 8, 0}, workspace, out),
            Evaluation::singular_mass);
}

TEST(Tape, SolvesTogetherWhatOneEquationCouples) {
  Graph graph;
  const Places places(graph);
  const Expression one = graph.number(1), zero = graph.number(0);
  TapeBuilder builder(graph, places.parameters, graph.symbol("t"), places.variables);
  const auto columns = builder.solve({.matrix = {{one, zero}, {graph.symbol("theta"), one}},
                                      .determinant = {},
                                      .right_hand_sides = {{one, zero}},
                                      .unknowns = {}});
  for (const Slot slot : columns[0]) builder.output(slot);
  const CompiledFunction function = builder.finish();
  Workspace workspace = function.bind(std::vector<double>{1, 1, 1});
  std::vector<double> out(2);
  ASSERT_EQ(function.evaluate(0, std::vector<double>{3, 0, 0, 0}, workspace, out), Evaluation::ok);
  EXPECT_EQ(out, (std::vector<double>{1, -3}));
}

class ModelsTape : public test::SystemTest {};
INSTANTIATE_TEST_SUITE_P(Systems, ModelsTape, testing::ValuesIn(test::all_systems()), test::system_name);

TEST_P(ModelsTape, GivesTheTreesValueOfEveryColumn) {
  const Dynamics dynamics(test::model_of(GetParam()),
                          std::vector<std::string>(model().scene.inputs.size(), "m*cos(3*t)"));
  std::vector<Column> columns = test::energy_columns(model());
  for (const auto& group : {momentum_columns(model()), position_columns(model()), validity_columns(model()),
                            report_columns(model())})
    columns.insert(columns.end(), group.begin(), group.end());
  const auto function = dynamics.columns(columns);
  each_state([&](Values state) {
    const std::vector<double> accelerations = test::outputs_of(dynamics.accelerations(), model(), state);
    for (std::size_t i = 0; i < accelerations.size(); ++i)
      state[model().scene.coordinates[i].name + "_ddot"] = accelerations[i];
    for (std::size_t i = 0; i < model().scene.held_lengths.size(); ++i) {
      state[model().scene.held_lengths[i].name] = test::value_of(model().parsed.held_values[i], state);
    }
    if (state.contains("F")) state["F"] = state.at("m") * std::cos(3 * state.at("t"));
    const std::vector<double> tape = test::outputs_of(*function, model(), state);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double tree = test::value_of(columns[i].value, state);
      double size = 1;
      for (const double a : accelerations) size = std::max(size, std::abs(a));
      EXPECT_NEAR(tape[i], tree, 1e-14 * size * (1 + std::abs(tree)) * 10) << columns[i].name;
    }
  });
}

}  // namespace
}  // namespace qdot
