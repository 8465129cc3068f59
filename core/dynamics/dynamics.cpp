#include "core/dynamics/dynamics.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "core/compile/tape_builder.hpp"
#include "core/expr/parse.hpp"

namespace qdot {
namespace {

Expression parsed_input(const Model& model, const std::string& text, Graph& graph) {
  std::vector<std::string> allowed{"t"};
  for (const Parameter& p : model.scene.parameters) allowed.push_back(p.name);
  return parse(text, graph, allowed);
}

/// Each input and its first two derivatives as functions of time, in a graph copied from the model's.
std::vector<Replacement> input_replacements(const Model& model, const std::vector<std::string>& texts,
                                            Graph& graph) {
  const Expression t = graph.adopt(model.parsed.symbols.t);
  const Symbols::Varying& inputs = model.parsed.symbols.inputs;
  std::vector<Replacement> replacements;
  for (std::size_t i = 0; i < inputs.value.size(); ++i) {
    const bool given = i < texts.size() && !texts[i].empty();
    const Expression value =
        given ? parsed_input(model, texts[i], graph) : graph.adopt(model.parsed.input_defaults[i]);
    const Expression rate = differentiate(value, t);
    replacements.emplace_back(graph.adopt(inputs.value[i]), value);
    replacements.emplace_back(graph.adopt(inputs.rate[i]), rate);
    replacements.emplace_back(graph.adopt(inputs.second_rate[i]), differentiate(rate, t));
  }
  return replacements;
}

std::vector<bool> zeros_among(std::span<const double> values) {
  std::vector<bool> zeros;
  for (const double value : values) zeros.push_back(value == 0);
  return zeros;
}

}  // namespace

/// A tape under construction on a private copy of the model's graph.
class Dynamics::Builder {
 public:
  Builder(const Model& model, const std::vector<std::string>& inputs)
      : Builder(model, inputs, *model.parsed.graph) {}

  /// On a copy of a graph that was itself copied from the model's.
  Builder(const Model& model, const std::vector<std::string>& inputs, const Graph& graph)
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

const CanonicalFunctions* Dynamics::canonical() const {
  const std::lock_guard lock(lazy_->mutex);
  if (!lazy_->canonical) lazy_->canonical = canonical_functions(specialized({}));
  return lazy_->canonical->get();
}

CompiledFunction Dynamics::compiled(const Graph& graph, std::span<const Expression> expressions) const {
  Builder builder(*model_, inputs_, graph);
  for (const Expression& of_graph : expressions) {
    const Expression e = builder.expression(of_graph);
    if (builder.needs_accelerations(e)) (void)builder.accelerations();
    builder.tape().output(e);
  }
  return builder.tape().finish();
}

std::shared_ptr<const CompiledFunction> Dynamics::columns(const std::vector<Column>& columns) const {
  std::vector<NodeId> key;
  std::vector<Expression> expressions;
  for (const Column& column : columns) {
    key.push_back(column.value.id());
    expressions.push_back(column.value);
  }
  const std::lock_guard lock(lazy_->mutex);
  std::shared_ptr<const CompiledFunction>& slot = lazy_->columns[key];
  if (!slot) slot = std::make_shared<const CompiledFunction>(compiled(*model_->parsed.graph, expressions));
  return slot;
}

Lagrangian Dynamics::specialized(const std::vector<bool>& vanishing) const {
  const Lagrangian own = copied(model_->lagrangian);
  return replaced(own, specialization(vanishing, own));
}

std::vector<Replacement> Dynamics::specialization(const std::vector<bool>& vanishing,
                                                  const Lagrangian& own) const {
  std::vector<Replacement> replacements = input_replacements(*model_, inputs_, *own.graph);
  for (std::size_t i = 0; i < vanishing.size(); ++i) {
    if (!vanishing[i]) continue;
    const Replacement zero{own.symbols.parameters[i], own.graph->number(0)};
    for (Replacement& input : replacements) input.second = substitute(input.second, {&zero, 1});
    replacements.push_back(zero);
  }
  return replacements;
}

Statics Dynamics::derived_statics(const std::vector<bool>& vanishing) const {
  const Lagrangian own = copied(model_->lagrangian);
  const std::vector<Replacement> replacements = specialization(vanishing, own);
  std::vector<Expression> divided;
  for (const Equation& equation : model_->equations.equations) {
    const Expression whole = own.graph->adopt(equation.left) - own.graph->adopt(equation.right);
    divided.push_back(substitute(whole, replacements));
  }
  return derive_statics(replaced(own, replacements), divided);
}

Conserved Dynamics::derived_conserved(const std::vector<bool>& vanishing) const {
  const Lagrangian lagrangian = specialized(vanishing);
  Conserved result{conserved_quantities(lagrangian, model_->scene), nullptr};
  std::vector<Expression> expressions;
  for (const ConservedQuantity& quantity : result.quantities) expressions.push_back(quantity.value);
  result.values = std::make_shared<const CompiledFunction>(compiled(*lagrangian.graph, expressions));
  return result;
}

std::shared_ptr<const Conserved> Dynamics::conserved(std::span<const double> parameters) const {
  const std::vector<bool> vanishing = zeros_among(parameters);
  const std::lock_guard lock(lazy_->mutex);
  std::shared_ptr<const Conserved>& slot = lazy_->conserved[vanishing];
  if (!slot) slot = std::make_shared<const Conserved>(derived_conserved(vanishing));
  return slot;
}

std::shared_ptr<const Statics> Dynamics::statics(std::span<const double> parameters) const {
  const std::vector<bool> vanishing = zeros_among(parameters);
  const std::lock_guard lock(lazy_->mutex);
  std::shared_ptr<const Statics>& slot = lazy_->statics[vanishing];
  if (!slot) slot = std::make_shared<const Statics>(derived_statics(vanishing));
  return slot;
}

CompiledEvent Dynamics::event(const std::string& text) const {
  const std::vector<SceneEvent>& named = model_->scene.events;
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (named[i].name != text) continue;
    const ParsedSceneEvent& event = model_->parsed.events[i];
    CompiledEvent result{compiled(*model_->parsed.graph, {&event.value, 1}), named[i].direction, {}};
    if (event.when) result.when = compiled(*model_->parsed.graph, {&*event.when, 1});
    return result;
  }
  Builder builder(*model_, inputs_);
  const ParsedEvent parsed = builder.parsed_event(text);
  builder.tape().output(parsed.expression);
  return {builder.tape().finish(), parsed.crossing, {}};
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
    columns.push_back(
        {"p_" + model.scene.coordinates[i].name, momentum_unit(model.scene, i), model.momenta[i]});
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

std::vector<Column> report_columns(const Model& model) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.reports.size(); ++i) {
    columns.push_back({model.scene.reports[i].name, model.scene.reports[i].unit, model.reports[i]});
  }
  return columns;
}

std::vector<double> values_at(const Dynamics& dynamics, const std::vector<Column>& columns,
                              std::span<const double> parameters, double t, std::span<const double> y) {
  const auto function = dynamics.columns(columns);
  Workspace workspace = function->bind(parameters);
  std::vector<double> values(columns.size());
  switch (function->evaluate(t, y, workspace, values)) {
    case Evaluation::ok:
      return values;
    case Evaluation::singular_mass:
      throw Error(ErrorCode::invalid_state, "The mass matrix has no inverse in this state.");
    case Evaluation::nonfinite:
      break;
  }
  std::string undefined;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!std::isfinite(values[i])) undefined += (undefined.empty() ? "" : ", ") + columns[i].name;
  }
  throw Error(ErrorCode::invalid_state, "In this state there is no finite value of " + undefined + ".");
}

}  // namespace qdot
