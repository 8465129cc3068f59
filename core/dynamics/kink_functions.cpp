#include "core/dynamics/kink_functions.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/dynamics/motion_builder.hpp"
#include "core/expr/print/print.hpp"

namespace qdot {
namespace {

bool may_bend(const Node& node) {
  if (const auto* call = std::get_if<Call>(&node)) {
    return call->function == Function::abs || call->function == Function::sign;
  }
  const auto* power = std::get_if<Power>(&node);
  return power != nullptr && !power->exponent.is_integer();
}

/// A quick look, as most equations have no kinks.
bool may_have_kinks(const Model& model, const InputTexts& inputs) {
  const Graph& graph = *model.parsed.graph;
  const bool has_input = std::ranges::any_of(inputs, [](const std::string& text) { return !text.empty(); });
  if (has_input || !model.parsed.input_defaults.empty()) return true;
  std::vector<NodeId> roots;
  for (const Expression& e : model.equations.forcing) roots.push_back(e.id());
  for (const auto* matrix : {&model.equations.mass_matrix, &model.equations.reactions}) {
    for (const auto& row : *matrix) {
      for (const Expression& entry : row) roots.push_back(entry.id());
    }
  }
  for (const auto& [held, value] : model.lagrangian.holding) roots.push_back(value.id());
  return std::ranges::any_of(reachable(graph, roots), [&](NodeId id) { return may_bend(graph.node(id)); });
}

/// Sides as a reader knows them.
std::string text_of(const Unfolded& kinks, std::size_t k) {
  Expression e = kinks.arguments[k];
  for (std::size_t i = k; i-- > 0;) {
    const Replacement side{kinks.sides[i], e.graph().call(Function::sign, kinks.arguments[i])};
    e = substitute(e, {&side, 1});
  }
  return print(e, Form::text);
}

}  // namespace

std::unique_ptr<const Kinks> kinks_of(const Model& model, const InputTexts& inputs) {
  if (!model.impulse.empty()) throw Error(ErrorCode::not_applicable, model.impulse);
  if (!may_have_kinks(model, inputs)) return nullptr;
  MotionBuilder builder(model, inputs, *model.parsed.graph, Staying{});
  const Unfolded& kinks = builder.kinks();
  if (kinks.arguments.empty()) return nullptr;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kinks.arguments.size(); ++k) {
    const Expression& u = kinks.arguments[k];
    names.push_back(text_of(kinks, k));
    builder.tape().output(u);
    builder.tape().output(differentiate(u, builder.time()));
    for (const auto* variables : {&builder.coordinates(), &builder.rates()}) {
      for (const Expression& y : *variables) builder.tape().output(differentiate(u, y));
    }
  }
  return std::make_unique<const Kinks>(Kinks{std::move(names), builder.tape().finish()});
}

std::shared_ptr<const KinkedMotion> kinked_motion(const Model& model, const InputTexts& inputs,
                                                  const Staying& staying) {
  using Function = std::shared_ptr<const CompiledFunction>;
  const auto compiled = [&](const auto& expression_of) -> Function {
    MotionBuilder builder(model, inputs, *model.parsed.graph, staying);
    builder.output(expression_of(builder.kinks()));
    return std::make_shared<const CompiledFunction>(builder.tape().finish());
  };
  try {
    auto result =
        std::make_shared<KinkedMotion>(KinkedMotion{accelerations_of(model, inputs, &staying), {}, {}, {}});
    for (std::size_t k = 0; k < staying.size(); ++k) {
      result->arguments.push_back(compiled([k](const Unfolded& kinks) { return kinks.arguments[k]; }));
      Function side, holds;
      if (staying[k]) {
        side = compiled([k](const Unfolded& kinks) { return kinks.sides[k]; });
        holds = compiled([k](const Unfolded& kinks) {
          const Expression& s = kinks.sides[k];
          return s.graph().number(1) - s * s;
        });
      }
      result->sides.push_back(side);
      result->holds.push_back(holds);
    }
    return result;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_applicable) throw;
    return nullptr;
  }
}

}  // namespace qdot
