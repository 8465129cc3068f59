#include "tests/support/states.hpp"

#include <array>
#include <stdexcept>

namespace qdot::test {
namespace {

double random_value(const Domain& domain, Random& random) {
  return domain.lower >= 0 ? random.real(0.2, 2) : random.real(-2, 2);
}

}  // namespace

Values random_state(const Model& model, Random& random) {
  Values state{{"t", random.real(-2, 2)}};
  for (const Parameter& p : model.scene.parameters) state[p.name] = random_value(p.domain, random);
  for (const Coordinate& q : model.scene.coordinates) {
    state[q.name] = random_value(q.domain, random);
    state[q.name + "_dot"] = random.real(-2, 2);
    state[q.name + "_ddot"] = random.real(-2, 2);
  }
  for (const Input& input : model.scene.inputs) {
    for (const char* derivative : {"", "_dot", "_ddot"}) state[input.name + derivative] = random.real(-2, 2);
  }
  return state;
}

std::vector<double> parameters_in(const Model& model, const Values& state) {
  std::vector<double> values;
  for (const Parameter& p : model.scene.parameters) values.push_back(state.at(p.name));
  return values;
}

std::vector<double> motion_in(const Model& model, const Values& state) {
  std::vector<double> y;
  for (const Coordinate& q : model.scene.coordinates) y.push_back(state.at(q.name));
  for (const Coordinate& q : model.scene.coordinates) y.push_back(state.at(q.name + "_dot"));
  return y;
}

double value_of(const Expression& e, const Values& state) {
  std::vector<Assignment> assignments;
  const std::array root{e.id()};
  for (const NodeId id : reachable(e.graph(), root)) {
    const auto* symbol = std::get_if<Symbol>(&e.graph().node(id));
    if (symbol == nullptr || symbol->name == "pi") continue;
    assignments.emplace_back(Expression(e.graph(), id), state.at(symbol->name));
  }
  return evaluate(e, assignments);
}

std::vector<double> outputs_of(const CompiledFunction& function, const Model& model, const Values& state) {
  Workspace workspace = function.bind(parameters_in(model, state));
  std::vector<double> out(function.outputs());
  if (function.evaluate(state.at("t"), motion_in(model, state), workspace, out) != Evaluation::ok)
    throw std::runtime_error("no value in this state");
  return out;
}

}  // namespace qdot::test
