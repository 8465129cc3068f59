#include "core/compile/taylor/translation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace qdot {

using taylor::Kind;
using taylor::Step;

namespace {

Kind sum_kind(std::size_t terms, std::size_t products) {
  static constexpr Kind kinds[3][4]{{Kind::sum, Kind::sum_1_0, Kind::sum_2_0, Kind::sum},
                                    {Kind::sum_0_1, Kind::sum_1_1, Kind::sum_2_1, Kind::sum_3_1},
                                    {Kind::sum_0_2, Kind::sum_1_2, Kind::sum_2_2, Kind::sum}};
  return products < 3 && terms < 4 ? kinds[products][terms] : Kind::sum;
}

constexpr double largest_entry = 1e280;  ///< of a matrix whose inverse loses no digits

/// That are no slots.
std::size_t most_rows_of_its_own(Operation operation) {
  switch (operation) {
    case Operation::sum_of_products:
    case Operation::power:
      return 0;
    case Operation::quotient:
    case Operation::square_root:
    case Operation::sine_cosine:
    case Operation::solve:
      return 1;
    case Operation::call:
      break;
  }
  return 6;
}

}  // namespace

TaylorTranslation::TaylorTranslation(const CompiledFunction& tape, const Workspace& constants,
                                     std::size_t coordinates)
    : tape_(tape),
      constants_(constants),
      coordinates_(coordinates),
      varies_(tape.slots_),
      forms_(tape.slots_),
      is_sum_(tape.slots_),
      uses_(tape.slots_) {
  std::size_t rows = tape.slots_ + 1;
  for (const Instruction& instruction : tape.body_) rows += most_rows_of_its_own(instruction.operation);
  rows_.assign((rows + 1) * taylor::stride, 0.0);
  const auto place = reinterpret_cast<std::uintptr_t>(rows_.data()) / sizeof(double);
  first_ = taylor::before_row + (3 - place % 4) % 4;
  rows_used_ = tape.slots_;
  start_.time = row(tape.parameters_);
  one_ = new_row();
  one_[0] = 1;
  for (std::size_t slot = 0; slot < tape.slots_; ++slot) row(slot)[0] = constants[slot];
  find_forms();
  count_uses();
  for (std::size_t i = 0; i <= tape.variables_; ++i) {
    start_at(static_cast<Slot>(tape.parameters_ + i));
  }
  for (const Instruction& instruction : tape.body_) {
    if (is_needed(instruction)) translate(instruction);
  }
  find_own_starts();
  std::vector<const double*> accelerations;
  for (const Slot slot : tape.outputs_) accelerations.push_back(row(slot));
  const std::size_t n = accelerations.size();
  program_ = {steps_.data(),
              steps_.size(),
              {n, row(tape.parameters_ + 1), kept(accelerations).data(), tape.variables_}};
  for (const Slot slot : tape.outputs_) start_at(slot);
}

/// Steps that begin with more than their slots' values.
void TaylorTranslation::find_own_starts() {
  auto partner = partners_.begin();
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    TaylorStart<double>::Own own{i, is_row_of_slot(steps_[i].out), {}, {}};
    switch (steps_[i].kind) {
      case Kind::sum_0_1:
        if (own.is_row_of_slot) continue;
        break;
      case Kind::hyperbolic:
        own.partner = partner->first;
        own.argument_slot = partner->second;
        ++partner;
        break;
      case Kind::quotient:
      case Kind::power:
      case Kind::root:
      case Kind::exponential:
      case Kind::tangent:
      case Kind::absolute:
      case Kind::sign:
        break;
      default:
        continue;
    }
    start_.own.push_back(own);
  }
}

taylor::Program TaylorTranslation::composition() const {
  taylor::Program program = program_;
  program.state.n = coordinates_;
  program.state.accelerations = nullptr;
  return program;
}

bool TaylorTranslation::is_of_state(const double* row) const {
  const double* first = program_.state.rows;
  return row >= first && row < first + tape_.variables_ * taylor::stride;
}

void TaylorTranslation::translate(const Instruction& instruction) {
  const Slot* operand = tape_.operands_.data() + instruction.first;
  Step step;
  step.out = row(instruction.out);
  start_at(instruction.out);
  switch (instruction.operation) {
    case Operation::sum_of_products:
      return add_sum(forms_[instruction.out], step.out);
    case Operation::quotient:
      if (is_sum_[instruction.out]) return add_sum(forms_[instruction.out], step.out);
      step.kind = Kind::quotient;
      step.x = row(operand[0]);
      step.y = row(operand[1]);
      step.aux = new_row();
      break;
    case Operation::power:
      step.kind = Kind::power;
      step.x = row(operand[0]);
      step.constant = constants_[operand[1]];
      break;
    case Operation::square_root:
      step.kind = Kind::root;
      step.x = row(operand[0]);
      step.aux = new_row();
      break;
    case Operation::sine_cosine:
      step.kind = Kind::sine_cosine;
      step.out2 = row(instruction.out + 1);
      start_at(instruction.out + 1);
      step.x = rate_row(operand[0]);
      step.argument = &constants_[operand[0]];
      break;
    case Operation::call:
      translate_call(instruction, step);
      break;
    case Operation::solve:
      return translate_solve(instruction);
  }
  steps_.push_back(step);
}

void TaylorTranslation::add_sum(const Form& form, double* out) {
  std::vector<taylor::Term> terms;
  std::vector<taylor::Product> products;
  for (const auto& [factor, x] : form.terms) terms.push_back({factor, row(x)});
  for (const auto& [factor, x, y] : form.products) products.push_back({factor, row(x), row(y), 0, 0});
  Step step;
  step.kind = sum_kind(terms.size(), products.size());
  step.constant = form.constant;
  step.term_count = static_cast<std::uint16_t>(terms.size());
  step.product_count = static_cast<std::uint16_t>(products.size());
  step.terms = kept(terms).data();
  const std::span<taylor::Product> kept_products = kept(products);
  step.products = kept_products.data();
  for (taylor::Product& product : kept_products) start_.products.push_back(&product);
  step.out = out;
  steps_.push_back(step);
  if (form.factors == Factors::rounded) begin_by_factors();
}

const double* TaylorTranslation::rate_row_of(Slot slot) {
  const auto index = slot - static_cast<Slot>(tape_.parameters_);
  return index == 0 ? one_ : row(slot + coordinates_);
}

const double* TaylorTranslation::rate_row(Slot argument) {
  if (is_coordinate(argument)) return rate_row_of(argument);
  Step step;
  step.out = new_row();
  if (has_rate_of_its_own(argument)) {
    step.kind = Kind::rate_of_sum;
    std::vector<taylor::Term> terms;
    for (const auto& [factor, x] : forms_[argument].terms) terms.push_back({factor, rate_row_of(x)});
    step.term_count = static_cast<std::uint16_t>(terms.size());
    step.terms = kept(terms).data();
  } else {
    step.kind = Kind::rate;
    step.x = row(argument);
  }
  steps_.push_back(step);
  return step.out;
}

void TaylorTranslation::translate_call(const Instruction& instruction, Step& step) {
  const Slot u = tape_.operands_[instruction.first];
  switch (instruction.function) {
    case Function::log:
      step.kind = Kind::logarithm;
      step.x = row(u);
      return;
    case Function::abs:
    case Function::sign:
      step.kind = instruction.function == Function::abs ? Kind::absolute : Kind::sign;
      step.x = row(u);
      return;
    case Function::exp:
      step.kind = Kind::exponential;
      break;
    case Function::tan:
    case Function::tanh:
      step.kind = Kind::tangent;
      step.constant = instruction.function == Function::tan ? 1 : -1;
      step.aux = new_row();
      break;
    case Function::sinh:
    case Function::cosh:
      step.kind = Kind::hyperbolic;
      step.constant = instruction.function == Function::cosh ? 1 : 0;
      step.out2 = new_row();
      partners_.emplace_back(instruction.function == Function::cosh ? Function::sinh : Function::cosh, u);
      break;
    case Function::asin:
    case Function::acos:
    case Function::atan:
      translate_arc(instruction, step);
      break;
    case Function::sin:
    case Function::cos:
      assert(false);  // a tape has them together
  }
  step.x = rate_row(u);
  step.argument = &constants_[u];
}

/// w = 1 + u^2, or the root of 1 - u^2.
void TaylorTranslation::translate_arc(const Instruction& instruction, Step& step) {
  const Slot u = tape_.operands_[instruction.first];
  const bool is_atan = instruction.function == Function::atan;
  step.kind = Kind::arc;
  step.constant = instruction.function == Function::acos ? -1 : 1;
  double* square = new_row();
  add_sum({1, {}, {{is_atan ? 1.0 : -1.0, u, u}}}, square);
  step.y = square;
  if (is_atan) return;
  Step root;
  root.kind = Kind::root;
  root.x = square;
  root.out = new_row();
  root.aux = new_row();
  steps_.push_back(root);
  step.y = root.out;
}

void TaylorTranslation::translate_solve(const Instruction& instruction) {
  const Slot* operand = tape_.operands_.data() + instruction.first;
  const std::size_t n = instruction.linear;
  for (std::size_t i = 1; i < n; ++i) start_at(static_cast<Slot>(instruction.out + i));
  if (is_sum_[instruction.out]) return add_sum(forms_[instruction.out], row(instruction.out));
  Step step;
  step.out = row(instruction.out);
  if (n == 1) {
    step.kind = Kind::quotient;
    step.x = row(operand[1]);
    step.y = row(operand[0]);
    step.aux = new_row();
    steps_.push_back(step);
    return;
  }
  TaylorStart<double>::System& system = start_.systems.emplace_back();
  system.n = n;
  system.has_determinant = instruction.has_determinant;
  if (instruction.has_determinant) system.determinant_slot = *operand++;
  system.matrix_slots.assign(operand, operand + n * n);
  system.matrix.resize(n * n);
  system.inverse.resize(n * n);
  std::vector<taylor::Entry> matrix;
  std::vector<const double*> right, start;
  std::vector<double*> unknowns;
  for (std::size_t i = 0; i < n * n; ++i) {
    start.push_back(&constants_[operand[i]]);
    const auto [factor, x] = entry(operand[i]);
    matrix.push_back({factor, varies_[x] ? row(x) : nullptr, 0});
  }
  for (std::size_t i = 0; i < n; ++i) {
    right.push_back(row(operand[n * n + i]));
    unknowns.push_back(row(instruction.out + i));
  }
  const std::span<taylor::Entry> entries = kept(matrix);
  const std::vector<taylor::Solve> solve{{static_cast<std::uint32_t>(n), entries.data(), kept(right).data(),
                                          kept(unknowns).data(), system.inverse.data(), kept(start).data()}};
  step.kind = n == 2 ? Kind::solve_2 : n == 3 ? Kind::solve_3 : Kind::solve;
  step.solve = kept(solve).data();
  start_.entries.push_back({entries, step.solve});
  steps_.push_back(step);
  const auto is_constant = [&](Slot slot) {
    return !varies_[slot] && std::abs(constants_[slot]) < largest_entry;
  };
  if (std::all_of(operand, operand + n * n, is_constant)) begin_by_factors();
}

}  // namespace qdot
