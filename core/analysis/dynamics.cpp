#include "core/analysis/dynamics.hpp"

#include <array>

#include "core/compile/tape_builder.hpp"
#include "core/expr/parse.hpp"

namespace qdot {

/// A tape under construction on a private copy of the model's graph.
class Dynamics::Builder {
 public:
  Builder(const Model& model, const std::vector<std::string>& inputs)
      : model_(model),
        graph_(*model.parsed.graph),
        q_(adopted(model.parsed.symbols.coordinates.value)),
        rates_(adopted(model.parsed.symbols.coordinates.rate)),
        accelerations_(adopted(model.parsed.symbols.coordinates.second_rate)),
        parameters_(adopted(model.parsed.symbols.parameters)),
        t_(graph_.adopt(model.parsed.symbols.t)) {
    for (const auto& [held, value] : model.lagrangian.holding) {
      replacements_.emplace_back(graph_.adopt(held), graph_.adopt(value));
    }
    replace_inputs(inputs);
    std::vector<Expression> variables = q_;
    variables.insert(variables.end(), rates_.begin(), rates_.end());
    tape_.emplace(graph_, parameters_, t_, variables);
  }

  [[nodiscard]] Expression expression(const Expression& of_model) {
    return substitute(graph_.adopt(of_model), replacements_);
  }

  [[nodiscard]] Expression parsed(const std::string& text) {
    std::vector<std::string> allowed{"t"};
    for (const auto* symbols : {&parameters_, &q_, &rates_}) {
      for (const Expression& symbol : *symbols) allowed.push_back(std::get<Symbol>(symbol.node()).name);
    }
    return parse(text, graph_, allowed);
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

  void replace_inputs(const std::vector<std::string>& texts) {
    const Symbols::Varying& inputs = model_.parsed.symbols.inputs;
    for (std::size_t i = 0; i < inputs.value.size(); ++i) {
      const bool given = i < texts.size() && !texts[i].empty();
      const Expression value = given ? parsed_input(texts[i]) : graph_.adopt(model_.parsed.input_defaults[i]);
      const Expression rate = differentiate(value, t_);
      replacements_.emplace_back(inputs.value[i], value);
      replacements_.emplace_back(inputs.rate[i], rate);
      replacements_.emplace_back(inputs.second_rate[i], differentiate(rate, t_));
    }
  }

  [[nodiscard]] Expression parsed_input(const std::string& text) {
    std::vector<std::string> allowed{"t"};
    for (const Parameter& p : model_.scene.parameters) allowed.push_back(p.name);
    return parse(text, graph_, allowed);
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

Dynamics::Dynamics(std::shared_ptr<const Model> model, const std::vector<std::string>& inputs)
    : model_(std::move(model)), inputs_(inputs), lazy_(std::make_unique<Lazy>()) {
  if (!inputs_.empty()) (void)accelerations();  // an input that does not parse is refused now
}

const CompiledFunction& Dynamics::accelerations() const {
  const std::lock_guard lock(lazy_->mutex);
  if (!lazy_->accelerations) {
    Builder builder(*model_, inputs_);
    for (const Slot slot : builder.accelerations()) builder.tape().output(slot);
    lazy_->accelerations = std::make_unique<CompiledFunction>(builder.tape().finish());
  }
  return *lazy_->accelerations;
}

const CompiledFunction& Dynamics::jacobian() const {
  const std::lock_guard lock(lazy_->mutex);
  if (!lazy_->jacobian) {
    Builder builder(*model_, inputs_);
    const std::vector<std::vector<Slot>> columns = builder.acceleration_derivatives();
    const std::size_t n = model_->degrees_of_freedom();
    const Slot zero = builder.tape().literal(0);
    const Slot one = builder.tape().literal(1);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < 2 * n; ++j) builder.tape().output(j == n + i ? one : zero);
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < 2 * n; ++j) builder.tape().output(columns[j][i]);
    }
    lazy_->jacobian = std::make_unique<CompiledFunction>(builder.tape().finish());
  }
  return *lazy_->jacobian;
}

std::shared_ptr<const CompiledFunction> Dynamics::columns(const std::vector<Column>& columns) const {
  std::vector<NodeId> key;
  for (const Column& column : columns) key.push_back(column.value.id());
  const std::lock_guard lock(lazy_->mutex);
  std::shared_ptr<const CompiledFunction>& slot = lazy_->columns[key];
  if (!slot) {
    Builder builder(*model_, inputs_);
    for (const Column& column : columns) {
      const Expression e = builder.expression(column.value);
      if (builder.needs_accelerations(e)) (void)builder.accelerations();
      builder.tape().output(e);
    }
    slot = std::make_shared<const CompiledFunction>(builder.tape().finish());
  }
  return slot;
}

CompiledFunction Dynamics::compile(const std::vector<std::string>& expressions) const {
  Builder builder(*model_, inputs_);
  for (const std::string& text : expressions) builder.tape().output(builder.parsed(text));
  return builder.tape().finish();
}

std::vector<Column> energy_columns(const Model& model) {
  std::vector<Column> columns;
  if (const Lagrangian& l = model.lagrangian; l.kinetic_energy) {
    columns.push_back({"T", "J", *l.kinetic_energy});
    columns.push_back({"V", "J", *l.potential_energy});
    columns.push_back({"energy", "J", *model.energy});
  }
  columns.push_back({"h", "J", model.jacobi});
  return columns;
}

std::vector<Column> momentum_columns(const Model& model) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.degrees_of_freedom(); ++i) {
    columns.push_back({"p_" + model.scene.coordinates[i].name, momentum_unit(model.scene, i), model.momenta[i]});
  }
  return columns;
}

std::vector<Column> position_columns(const Model& model) {
  static constexpr std::array<const char*, 3> axes{"_x", "_y", "_z"};
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.scene.points.size(); ++i) {
    const Vector& point = model.parsed.points[i];
    for (std::size_t k = 0; k < point.size(); ++k) {
      columns.push_back({model.scene.points[i].name + axes[k], "m", point[k]});
    }
  }
  return columns;
}

std::vector<Column> acceleration_columns(const Model& model) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.degrees_of_freedom(); ++i) {
    const Coordinate& q = model.scene.coordinates[i];
    columns.push_back({q.name + "_ddot", q.unit == "1" ? "1/s^2" : q.unit + "/s^2",
                       model.parsed.symbols.coordinates.second_rate[i]});
  }
  return columns;
}

std::vector<Column> validity_columns(const Model& model) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.validity.size(); ++i) {
    columns.push_back({model.scene.valid_while[i].name, model.scene.valid_while[i].unit, model.validity[i]});
  }
  return columns;
}

}  // namespace qdot
