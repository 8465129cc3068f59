#include "core/dynamics/motion_builder.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/expr/kept_terms.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

[[noreturn]] void refuse() {
  throw Error(ErrorCode::not_applicable, "the motion does not stay on such a kink");
}

}  // namespace

MotionBuilder::MotionBuilder(const Model& model, const InputTexts& inputs, const Graph& graph)
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
  unknowns_ = adopted(model.system.unknowns);
  std::vector<Expression> variables = q_;
  variables.insert(variables.end(), rates_.begin(), rates_.end());
  tape_.emplace(graph_, parameters_, t_, variables);
}

MotionBuilder::MotionBuilder(const Model& model, const InputTexts& inputs, const Graph& graph,
                             const Staying& staying)
    : MotionBuilder(model, inputs, graph) {
  unfold();
  for (std::size_t k = 0; k < staying.size(); ++k) {
    if (staying[k]) unknown_sides_.push_back(kinks_.sides[k]);
  }
  for (const Expression& u : kinks_.arguments) {
    if (depends_on(u, unknown_sides_)) refuse();
  }
  for (std::size_t k = 0; k < staying.size(); ++k) {
    if (staying[k]) stay_on(k);
  }
  std::vector<Expression> parameters = parameters_, variables = q_;
  for (std::size_t k = 0; k < kinks_.sides.size(); ++k) {
    const bool is_unknown = k < staying.size() && staying[k];
    parameters.push_back(is_unknown ? graph_.symbol("no side " + std::to_string(k + 1)) : kinks_.sides[k]);
  }
  variables.insert(variables.end(), rates_.begin(), rates_.end());
  tape_.emplace(graph_, parameters, t_, variables);
}

std::vector<Expression> MotionBuilder::adopted(const std::vector<Expression>& symbols) {
  std::vector<Expression> result;
  for (const Expression& symbol : symbols) result.push_back(graph_.adopt(symbol));
  return result;
}

Expression MotionBuilder::expression(const Expression& of_model) const {
  Expression e = substitute(graph_.adopt(of_model), replacements_);
  if (!kinks_.replacements.empty()) e = substitute(e, kinks_.replacements);
  return known_.empty() ? e : substitute(e, known_);
}

ParsedEvent MotionBuilder::parsed_event(const std::string& text, const ExponentValues& exponents) {
  std::vector<std::string> allowed{"t"};
  std::vector<Expression> multipliers = adopted(model_.parsed.symbols.multipliers);
  for (auto* symbols : {&parameters_, &q_, &rates_, &multipliers}) {
    for (const Expression& symbol : *symbols) allowed.push_back(std::get<Symbol>(symbol.node()).name);
  }
  ParsedEvent event = parse_event(text, graph_, allowed);
  if (exponents.empty()) return event;
  FoundExponents found;
  ExponentSymbols symbols = exponent_symbols_of(model_.scene, model_.parsed.symbols);
  symbols.parameters = parameters_;
  event.expression = with_exponents(event.expression, symbols, exponents, found);
  return event;
}

void MotionBuilder::take_equations() {
  if (!right_.empty()) return;
  for (const Expression& e : model_.system.right) right_.push_back(expression(e));
  for (const auto& row : model_.system.matrix) {
    matrix_.emplace_back();
    for (const Expression& entry : row) matrix_.back().push_back(expression(entry));
  }
  if (model_.equations.determinant && !model_.has_constraints())
    determinant_ = expression(*model_.equations.determinant);
}

/// Kinks of the equations are found in the same order in every copy of the graph.
void MotionBuilder::unfold() {
  take_equations();
  std::vector<Expression> all = right_;
  for (const auto& row : matrix_) all.insert(all.end(), row.begin(), row.end());
  if (determinant_) all.push_back(*determinant_);
  std::vector<Expression> variables{t_};
  variables.insert(variables.end(), q_.begin(), q_.end());
  variables.insert(variables.end(), rates_.begin(), rates_.end());
  kinks_ = unfolded(all, variables);
  auto smooth = kinks_.smooth.begin();
  for (Expression& e : right_) e = *smooth++;
  for (auto& row : matrix_) {
    for (Expression& entry : row) entry = *smooth++;
  }
  if (determinant_) determinant_ = *smooth;
}

/// w = u, or u' where no velocity stands in u: w' = slope . q'' + rest = 0.
void MotionBuilder::stay_on(std::size_t kink) {
  const Expression side = kinks_.sides[kink];
  std::vector<Replacement> rates{{t_, graph_.number(1)}};
  for (std::size_t i = 0; i < q_.size(); ++i) rates.emplace_back(q_[i], rates_[i]);
  Expression w = kinks_.arguments[kink];
  if (!depends_on(w, rates_)) w = total_derivative(w, rates);
  std::vector<Expression> slope, half;
  for (const Expression& v : rates_) slope.push_back(simplify(differentiate(w, v)));
  const Expression rest = simplify(total_derivative(w, rates));
  Expression unknown = side;
  half = split_forces(side);
  if (auto of_product = split_reactions(side, unknown)) {
    const bool acts_alone = std::ranges::any_of(half, [](const Expression& h) { return !h.is_zero(); });
    if (acts_alone) refuse();
    half = std::move(*of_product);
  }
  determinant_.reset();
  std::vector<std::size_t> moved;
  for (std::size_t j = 0; j < slope.size(); ++j) {
    if (!slope[j].is_zero()) moved.push_back(j);
  }
  if (moved.empty()) refuse();
  const std::size_t j = moved.front();
  if (moved.size() == 1 && unknowns_[j] == accelerations_[j]) {
    eliminate(j, -rest / slope[j], half, unknown);
  } else {
    append(slope, rest, half, unknown);
  }
}

/// f = g + half s: g stays at the right.
std::vector<Expression> MotionBuilder::split_forces(const Expression& side) {
  std::vector<Expression> half;
  for (Expression& f : right_) {
    const Replacement ahead{side, graph_.number(1)}, behind{side, graph_.number(-1)};
    const Expression one = substitute(f, {&ahead, 1}), other = substitute(f, {&behind, 1});
    half.push_back(shortened(Number::ratio(1, 2) * (one - other)));
    if (depends_on(half.back(), unknown_sides_)) refuse();
    f = shortened(Number::ratio(1, 2) * (one + other));
  }
  return half;
}

/// Entries a + b s of the column of one multiplier lambda: a lambda + b (s lambda).
std::optional<std::vector<Expression>> MotionBuilder::split_reactions(const Expression& side,
                                                                      Expression& unknown) {
  std::optional<std::size_t> column;
  for (const auto& row : matrix_) {
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (!depends_on(row[j], side)) continue;
      if (column && *column != j) refuse();
      column = j;
    }
  }
  if (!column) return std::nullopt;
  const std::vector<Expression> multipliers = adopted(model_.parsed.symbols.multipliers);
  if (std::ranges::find(multipliers, unknowns_[*column]) == multipliers.end()) refuse();
  std::vector<Expression> half;
  for (auto& row : matrix_) {
    Expression& entry = row[*column];
    const Replacement ahead{side, graph_.number(1)}, behind{side, graph_.number(-1)};
    const Expression one = substitute(entry, {&ahead, 1}), other = substitute(entry, {&behind, 1});
    half.push_back(simplify(Number::ratio(1, 2) * (other - one)));
    if (depends_on(half.back(), unknown_sides_)) refuse();
    entry = simplify(Number::ratio(1, 2) * (one + other));
  }
  unknown = graph_.symbol("product with " + std::get<Symbol>(side.node()).name);
  quotients_.emplace_back(side, unknown / unknowns_[*column]);
  return half;
}

/// Puts the side in the place of q_j'' among the unknowns, for that acceleration is known.
void MotionBuilder::eliminate(std::size_t j, const Expression& acceleration,
                              const std::vector<Expression>& half, const Expression& side) {
  for (std::size_t i = 0; i < matrix_.size(); ++i) {
    right_[i] = right_[i] - matrix_[i][j] * acceleration;
    matrix_[i][j] = i < half.size() ? -half[i] : graph_.number(0);
  }
  known_.emplace_back(accelerations_[j], acceleration);
  unknowns_[j] = side;
}

void MotionBuilder::append(const std::vector<Expression>& slope, const Expression& rest,
                           const std::vector<Expression>& half, const Expression& side) {
  const Expression zero = graph_.number(0);
  std::vector<Expression> row(matrix_.size() + 1, zero);
  Expression right = -rest;
  for (std::size_t j = 0; j < slope.size(); ++j) {
    if (unknowns_[j] == accelerations_[j]) {
      row[j] = slope[j];
    } else {
      right = right - slope[j] * substitute(accelerations_[j], known_);
    }
  }
  for (std::size_t i = 0; i < matrix_.size(); ++i) matrix_[i].push_back(i < half.size() ? -half[i] : zero);
  matrix_.push_back(row);
  right_.push_back(right);
  unknowns_.push_back(side);
}

TapeBuilder::LinearSystem MotionBuilder::system(std::vector<std::vector<Expression>> right_hand_sides) const {
  return {matrix_, determinant_, std::move(right_hand_sides), unknowns_};
}

const std::vector<Slot>& MotionBuilder::accelerations() {
  if (is_solved_) return solution_;
  is_solved_ = true;
  take_equations();
  (void)tape_->solve(system({right_}));
  for (const Expression& a : accelerations_) {
    solution_.push_back(tape_->slot(known_.empty() ? a : substitute(a, known_)));
  }
  return solution_;
}

/// df/dy - dM/dy x.
std::vector<Expression> MotionBuilder::derivative_column(const Expression& y) const {
  std::vector<Expression> column = right_;
  for (std::size_t i = 0; i < column.size(); ++i) {
    column[i] = differentiate(column[i], y);
    for (std::size_t j = 0; j < column.size(); ++j) {
      column[i] = column[i] - differentiate(matrix_[i][j], y) * unknowns_[j];
    }
  }
  return column;
}

std::vector<std::vector<Slot>> MotionBuilder::acceleration_derivatives() {
  (void)accelerations();
  std::vector<std::vector<Expression>> columns;
  std::vector<Expression> variables = q_;
  variables.insert(variables.end(), rates_.begin(), rates_.end());
  for (const Expression& y : variables) columns.push_back(derivative_column(y));
  TapeBuilder::LinearSystem again = system(columns);
  again.unknowns.clear();
  std::vector<std::vector<Slot>> slopes = tape_->solve(again);
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    slopes[k].resize(accelerations_.size());
    for (const auto& [symbol, value] : known_) {
      const auto j = std::ranges::find(accelerations_, symbol) - accelerations_.begin();
      slopes[k][static_cast<std::size_t>(j)] = tape_->slot(differentiate(value, variables[k]));
    }
  }
  return slopes;
}

void MotionBuilder::output(const Expression& e) {
  const Expression known = quotients_.empty() ? e : substitute(e, quotients_);
  if (depends_on(known, unknowns_)) (void)accelerations();
  tape_->output(known);
}

bool MotionBuilder::output_by_accelerations(const Expression& e) {
  if (!depends_on(e, accelerations_)) return false;
  if (depends_on(e, adopted(model_.parsed.symbols.multipliers))) return false;
  std::vector<Expression> variables = q_;
  variables.insert(variables.end(), rates_.begin(), rates_.end());
  variables.insert(variables.end(), accelerations_.begin(), accelerations_.end());
  tape_.emplace(graph_, parameters_, t_, variables);
  tape_->output(e);
  return true;
}

}  // namespace qdot
