#include "core/dynamics/inputs.hpp"

#include "core/expr/parse.hpp"

namespace qdot {
namespace {

Expression parsed_input(const Model& model, const std::string& text, Graph& graph) {
  std::vector<std::string> allowed{"t"};
  for (const Parameter& p : model.scene.parameters) allowed.push_back(p.name);
  return parse(text, graph, allowed);
}

}  // namespace

std::vector<Replacement> input_replacements(const Model& model, const InputTexts& inputs, Graph& graph) {
  const Expression t = graph.adopt(model.parsed.symbols.t);
  const Symbols::Varying& symbols = model.parsed.symbols.inputs;
  std::vector<Replacement> replacements;
  for (std::size_t i = 0; i < symbols.value.size(); ++i) {
    const bool given = i < inputs.size() && !inputs[i].empty();
    const Expression value =
        given ? parsed_input(model, inputs[i], graph) : graph.adopt(model.parsed.input_defaults[i]);
    const Expression rate = differentiate(value, t);
    replacements.emplace_back(graph.adopt(symbols.value[i]), value);
    replacements.emplace_back(graph.adopt(symbols.rate[i]), rate);
    replacements.emplace_back(graph.adopt(symbols.second_rate[i]), differentiate(rate, t));
  }
  return replacements;
}

}  // namespace qdot
