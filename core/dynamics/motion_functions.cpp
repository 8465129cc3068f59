#include "core/dynamics/motion_functions.hpp"

#include "core/compile/tape_builder.hpp"
#include "core/expr/parse.hpp"

namespace qdot {
namespace {

/// A tape under construction on a private copy of the model's graph.
class Builder {
 public:
  Builder(const Model& model, const InputTexts& inputs) : Builder(model, inputs, *model.parsed.graph) {}

  /// On a copy of a graph that was itself copied from the model's.
  Builder(const Model& model, const InputTexts& inputs, const Graph& graph)
      : model_(model),
        graph_(graph),
        q_(adopted(model.parsed.symbols.coordinates.value)),
        rates_(adopted(model.parsed.symbols.coordinates.rate)),
        accelerations_(adopted(model.parsed.symbols.coordinates.second_rate)),
        parameters_(adopted(model.parsed.symbols.parameters)),
        t_(graph_.adopt(model.parsed.symbols.t)) {
    for (const auto& [held, value] : model.lagrangian.holding) {
      replacements_.emplace_back(graph_.adopt(held), graph_.adopt(value));
    }
    for (const Replacement& replacement : input_replacements(model, inputs, graph_)) {
      replacements_.push_back(replacement);
    }
    std::vector<Expression> variables = q_;
    variables.insert(variables.end(), rates_.begin(), rates_.end());
    tape_.emplace(graph_, parameters_, t_, variables);
  }

  [[nodiscard]] Expression expression(const Expression& of_model) {
    return substitute(graph_.adopt(of_model), replacements_);
  }

  [[nodiscard]] ParsedEvent parsed_event(const std::string& text) {
    std::vector<std::string> allowed{"t"};
    for (const auto* symbols : {&parameters_, &q_, &rates_}) {
      for (const Expression& symbol : *symbols) allowed.push_back(std::get<Symbol>(symbol.node()).name);
    }
    return parse_event(text, graph_, allowed);
  }

  [[nodiscard]] bool needs_accelerations(const Expression& e) const { return depends_on(e, accelerations_); }

  /// Slots of q''.
  const std::vector<Slot>& accelerations() {
    if (solution_.empty()) solution_ = tape_->solve(system({forcing()}))[0];
    return solution_;
  }

  /// Slots of dq''/dy_j for every y_j of (q, q').
  std::vector<std::vector<Slot>> acceleration_derivatives() {
    (void)accelerations();
    std::vector<std::vector<Expression>> columns;
    for (const auto* variables : {&q_, &rates_}) {
      for (const Expression& y : *variables) columns.push_back(derivative_column(y));
    }
    TapeBuilder::LinearSystem again = system(columns);
    again.unknowns.clear();
    return tape_->solve(again);
  }

  [[nodiscard]] TapeBuilder& tape() { return *tape_; }

 private:
  [[nodiscard]] std::vector<Expression> adopted(const std::vector<Expression>& symbols) {
    std::vector<Expression> result;
    for (const Expression& symbol : symbols) result.push_back(graph_.adopt(symbol));
    return result;
  }

  [[nodiscard]] std::vector<Expression> forcing() {
    std::vector<Expression> f;
    for (const Expression& e : model_.equations.forcing) f.push_back(expression(e));
    return f;
  }

  [[nodiscard]] Matrix mass() {
    Matrix m;
    for (const auto& row : model_.equations.mass_matrix) {
      m.emplace_back();
      for (const Expression& entry : row) m.back().push_back(expression(entry));
    }
    return m;
  }

  [[nodiscard]] TapeBuilder::LinearSystem system(std::vector<std::vector<Expression>> right_hand_sides) {
    TapeBuilder::LinearSystem result{mass(), std::nullopt, std::move(right_hand_sides), accelerations_};
    if (model_.equations.determinant) result.determinant = expression(*model_.equations.determinant);
    return result;
  }

  /// df/dy - dM/dy q''.
  [[nodiscard]] std::vector<Expression> derivative_column(const Expression& y) {
    const Matrix m = mass();
    std::vector<Expression> column = forcing();
    for (std::size_t i = 0; i < column.size(); ++i) {
      column[i] = differentiate(column[i], y);
      for (std::size_t j = 0; j < column.size(); ++j) {
        column[i] = column[i] - differentiate(m[i][j], y) * accelerations_[j];
      }
    }
    return column;
  }

  const Model& model_;
  Graph graph_;
  std::vector<Expression> q_, rates_, accelerations_, parameters_;
  Expression t_;
  std::vector<Replacement> replacements_;
  std::optional<TapeBuilder> tape_;
  std::vector<Slot> solution_;
};

}  // namespace

CompiledFunction accelerations_of(const Model& model, const InputTexts& inputs) {
  Builder builder(model, inputs);
  for (const Slot slot : builder.accelerations()) builder.tape().output(slot);
  return builder.tape().finish();
}

CompiledFunction jacobian_of(const Model& model, const InputTexts& inputs) {
  Builder builder(model, inputs);
  const std::vector<std::vector<Slot>> columns = builder.acceleration_derivatives();
  const std::size_t n = model.degrees_of_freedom();
  const Slot zero = builder.tape().literal(0);
  const Slot one = builder.tape().literal(1);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < 2 * n; ++j) builder.tape().output(j == n + i ? one : zero);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < 2 * n; ++j) builder.tape().output(columns[j][i]);
  }
  return builder.tape().finish();
}

CompiledFunction compiled_along_motion(const Model& model, const InputTexts& inputs, const Graph& graph,
                                       std::span<const Expression> expressions) {
  Builder builder(model, inputs, graph);
  for (const Expression& of_graph : expressions) {
    const Expression e = builder.expression(of_graph);
    if (builder.needs_accelerations(e)) (void)builder.accelerations();
    builder.tape().output(e);
  }
  return builder.tape().finish();
}

CompiledEvent compiled_event(const Model& model, const InputTexts& inputs, const std::string& text) {
  const auto compiled = [&](const Expression& e) {
    return compiled_along_motion(model, inputs, *model.parsed.graph, {&e, 1});
  };
  const std::vector<SceneEvent>& named = model.scene.events;
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (named[i].name != text) continue;
    const ParsedSceneEvent& event = model.parsed.events[i];
    CompiledEvent result{compiled(event.value), named[i].direction, {}};
    if (event.when) result.when = compiled(*event.when);
    return result;
  }
  Builder builder(model, inputs);
  const ParsedEvent parsed = builder.parsed_event(text);
  builder.tape().output(parsed.expression);
  return {builder.tape().finish(), parsed.crossing, {}};
}

}  // namespace qdot
