#include "core/dynamics/motion_functions.hpp"

#include <memory>

#include "core/dynamics/motion_builder.hpp"

namespace qdot {
namespace {

std::unique_ptr<MotionBuilder> builder_on(const Model& model, const InputTexts& inputs, const Graph& graph,
                                          const Staying* staying) {
  if (staying == nullptr) return std::make_unique<MotionBuilder>(model, inputs, graph);
  return std::make_unique<MotionBuilder>(model, inputs, graph, *staying);
}

}  // namespace

CompiledFunction accelerations_of(const Model& model, const InputTexts& inputs, const Staying* staying) {
  const auto builder = builder_on(model, inputs, *model.parsed.graph, staying);
  for (const Slot slot : builder->accelerations()) builder->tape().output(slot);
  return builder->tape().finish();
}

CompiledFunction jacobian_of(const Model& model, const InputTexts& inputs, const Staying* staying) {
  const auto builder = builder_on(model, inputs, *model.parsed.graph, staying);
  TapeBuilder& tape = builder->tape();
  const std::vector<std::vector<Slot>> columns = builder->acceleration_derivatives();
  const std::size_t n = model.degrees_of_freedom();
  const Slot zero = tape.literal(0);
  const Slot one = tape.literal(1);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < 2 * n; ++j) tape.output(j == n + i ? one : zero);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < 2 * n; ++j) tape.output(columns[j][i]);
  }
  return tape.finish();
}

CompiledFunction compiled_along_motion(const Model& model, const InputTexts& inputs, const Graph& graph,
                                       std::span<const Expression> expressions, const Staying* staying) {
  const auto builder = builder_on(model, inputs, graph, staying);
  for (const Expression& of_graph : expressions) builder->output(builder->expression(of_graph));
  return builder->tape().finish();
}

std::optional<CompiledFunction> compiled_by_accelerations(const Model& model, const InputTexts& inputs,
                                                          const Graph& graph, const Expression& of_graph) {
  MotionBuilder builder(model, inputs, graph);
  if (!builder.output_by_accelerations(builder.expression(of_graph))) return std::nullopt;
  return builder.tape().finish();
}

CompiledEvent compiled_event(const Model& model, const InputTexts& inputs, const std::string& text,
                             const ExponentValues& exponents, const Staying* staying) {
  const auto compiled = [&](const Expression& e) {
    return compiled_along_motion(model, inputs, *model.parsed.graph, {&e, 1}, staying);
  };
  const std::vector<SceneEvent>& named = model.scene.events;
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (named[i].name != text) continue;
    const ParsedSceneEvent& event = model.parsed.events[i];
    CompiledEvent result{compiled(event.value), named[i].direction, {}};
    if (event.when) result.when = compiled(*event.when);
    return result;
  }
  const auto builder = builder_on(model, inputs, *model.parsed.graph, staying);
  const ParsedEvent parsed = builder->parsed_event(text, exponents);
  builder->output(parsed.expression);
  return {builder->tape().finish(), parsed.crossing, {}};
}

}  // namespace qdot
