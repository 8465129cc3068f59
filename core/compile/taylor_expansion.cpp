#include "core/compile/taylor_expansion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace qdot {
namespace {

using taylor::Kind;
using taylor::Step;

taylor::Kernel kernel_for(InstructionSet set) {
  return set == InstructionSet::automatic && __builtin_cpu_supports("avx2") ? taylor::avx2::expand
                                                                            : taylor::plain::expand;
}

Kind kind_of(Function function) {
  switch (function) {
    case Function::sin:
    case Function::cos:
      return Kind::sine_cosine;
    case Function::tan:
    case Function::tanh:
      return Kind::tangent;
    case Function::asin:
    case Function::acos:
    case Function::atan:
      return Kind::arc;
    case Function::sinh:
    case Function::cosh:
      return Kind::hyperbolic;
    case Function::exp:
      return Kind::exponential;
    case Function::log:
      return Kind::logarithm;
    case Function::abs:
    case Function::sign:
      break;
  }
  assert(false);  // has_taylor_expansion() says no
  return Kind::sum;
}

}  // namespace

bool has_taylor_expansion(const CompiledFunction& accelerations) {
  const auto tape = accelerations.instructions();
  return std::none_of(tape.begin(), tape.end(), [](const Instruction& i) {
    const bool is_kink = i.function == Function::abs || i.function == Function::sign;
    return (i.operation == Operation::call && is_kink) || (i.operation == Operation::solve && i.products > 1);
  });
}

TaylorExpansion::TaylorExpansion(const CompiledFunction& accelerations, std::span<const double> parameters,
                                 InstructionSet instruction_set)
    : tape_(accelerations),
      kernel_(kernel_for(instruction_set)),
      workspace_(accelerations.bind(parameters)),
      accelerations_(accelerations.outputs()) {
  constexpr std::size_t most_auxiliary_rows = 5;  // of one instruction: k u_k, w, 1, u^2 and its root
  rows_.assign((tape_.slots_ + 1 + most_auxiliary_rows * tape_.body_.size()) * taylor::stride, 0.0);
  rows_used_ = tape_.slots_;
  varies_.assign(tape_.slots_, false);
  for (std::size_t i = 0; i <= tape_.variables_; ++i) varies_[tape_.parameters_ + i] = true;
  for (std::size_t slot = 0; slot < tape_.slots_; ++slot) row(slot)[0] = workspace_[slot];
  for (const Instruction& instruction : tape_.body_) translate(instruction);
  for (std::size_t slot = 0; slot < tape_.slots_; ++slot) {
    if (varies_[slot]) varying_slots_.push_back(static_cast<std::uint32_t>(slot));
  }
  std::vector<double*> state, outputs;
  for (std::size_t i = 0; i < tape_.variables_; ++i) state.push_back(row(tape_.parameters_ + 1 + i));
  for (const Slot slot : tape_.outputs_) outputs.push_back(row(slot));
  lists_.push_back(state);
  program_ = {
      steps_.data(), steps_.size(), {outputs.size(), lists_.back().data(), pointers(std::move(outputs))}};
}

double* TaylorExpansion::new_row() { return row(rows_used_++); }

const double* const* TaylorExpansion::pointers(std::vector<double*> list) {
  lists_.push_back(std::move(list));
  return lists_.back().data();
}

void TaylorExpansion::translate(const Instruction& instruction) {
  const Slot* operand = tape_.operands_.data() + instruction.first;
  Step step;
  step.out = row(instruction.out);
  varies_[instruction.out] = true;
  std::size_t count = 1;
  switch (instruction.operation) {
    case Operation::sum_of_products:
      step.kind = Kind::sum;
      step.pairs = instruction.linear;
      step.triples = instruction.products;
      count = 2 * instruction.linear + 3 * instruction.products;
      break;
    case Operation::quotient:
      step.kind = Kind::quotient;
      count = 2;
      break;
    case Operation::power:
      step.kind = Kind::power;
      step.constant = workspace_[operand[1]];
      break;
    case Operation::square_root:
      step.kind = Kind::root;
      break;
    case Operation::sine_cosine:
      step.kind = Kind::sine_cosine;
      step.out2 = row(instruction.out + 1);
      varies_[instruction.out + 1] = true;
      step.aux = new_row();
      break;
    case Operation::call:
      translate_call(instruction, step);
      break;
    case Operation::solve:
      return translate_solve(instruction, step);
  }
  std::vector<double*> operands;
  for (std::size_t i = 0; i < count; ++i) operands.push_back(row(operand[i]));
  step.operands = pointers(std::move(operands));
  steps_.push_back(step);
}

/// out = factor u^2, as a step of its own; `factor` is also the coefficient's row.
void TaylorExpansion::add_square(double* u, double* out, double factor) {
  double* coefficient = new_row();
  coefficient[0] = factor;
  Step step;
  step.kind = Kind::sum;
  step.triples = 1;
  step.operands = pointers({coefficient, u, u});
  step.out = out;
  steps_.push_back(step);
}

void TaylorExpansion::translate_call(const Instruction& instruction, Step& step) {
  double* u = row(tape_.operands_[instruction.first]);
  step.kind = kind_of(instruction.function);
  step.aux = new_row();
  if (step.kind == Kind::hyperbolic) {
    step.constant = instruction.function == Function::cosh ? 1 : -1;
    step.out2 = new_row();
  }
  if (step.kind == Kind::tangent) {
    step.constant = instruction.function == Function::tan ? 1 : -1;
    step.aux2 = new_row();
  }
  if (step.kind != Kind::arc) return;
  step.constant = instruction.function == Function::acos ? -1 : 1;
  step.aux2 = new_row();
  if (instruction.function == Function::atan) return add_square(u, step.aux2, 1);
  double* square = new_row();
  add_square(u, square, -1);
  Step root;
  root.kind = Kind::root;
  root.operands = pointers({square});
  root.out = step.aux2;
  steps_.push_back(root);
}

void TaylorExpansion::translate_solve(const Instruction& instruction, Step& step) {
  const Slot* operand = tape_.operands_.data() + instruction.first;
  const std::size_t n = instruction.linear;
  for (std::size_t i = 0; i < n; ++i) varies_[instruction.out + i] = true;
  if (n == 1) {
    step.kind = Kind::quotient;
    step.operands = pointers({row(operand[1]), row(operand[0])});
    steps_.push_back(step);
    return;
  }
  Factored& factored = factored_.emplace_back();
  factored.n = n;
  factored.has_determinant = instruction.has_determinant;
  if (instruction.has_determinant) factored.determinant_slot = *operand++;
  factored.matrix_slots.assign(operand, operand + n * n);
  factored.matrix.resize(n * n);
  std::vector<double*> matrix, right, unknowns;
  for (std::size_t i = 0; i < n * n; ++i) {
    matrix.push_back(varies_[operand[i]] ? row(operand[i]) : nullptr);
  }
  for (std::size_t i = 0; i < n; ++i) {
    right.push_back(row(operand[n * n + i]));
    unknowns.push_back(row(instruction.out + i));
  }
  lists_.push_back(unknowns);
  double* const* unknown_rows = lists_.back().data();
  solves_.push_back({static_cast<std::uint32_t>(n), pointers(std::move(matrix)), pointers(std::move(right)),
                     unknown_rows, &TaylorExpansion::substitute, &factored});
  step.kind = Kind::solve;
  step.solve = &solves_.back();
  steps_.push_back(step);
}

void TaylorExpansion::substitute(const void* pointer, double* b) {
  const auto& factored = *static_cast<const Factored*>(pointer);
  const double* m = factored.matrix.data();
  if (!factored.has_determinant) {
    return substitute_linear(factored.n, factored.matrix, factored.row, {b, factored.n});
  }
  const double x = (m[3] * b[0] - m[1] * b[1]) / factored.determinant;
  b[1] = (m[0] * b[1] - m[2] * b[0]) / factored.determinant;
  b[0] = x;
}

bool TaylorExpansion::factor() {
  for (Factored& factored : factored_) {
    for (std::size_t i = 0; i < factored.matrix.size(); ++i) {
      factored.matrix[i] = workspace_[factored.matrix_slots[i]];
    }
    if (factored.has_determinant) {
      factored.determinant = workspace_[factored.determinant_slot];
    } else if (!factor_linear(factored.n, factored.matrix, factored.row)) {
      return false;
    }
  }
  return true;
}

void TaylorExpansion::start_auxiliary(const Step& step) {
  switch (step.kind) {
    case Kind::sum:  // 1 + u^2 or 1 - u^2, where it is a row of our own
      if (step.out >= row(tape_.slots_)) {
        step.out[0] = (1 + step.operands[0][0] * step.operands[1][0] * step.operands[2][0]);
      }
      break;
    case Kind::root:
      if (step.out >= row(tape_.slots_)) step.out[0] = (std::sqrt(step.operands[0][0]));
      break;
    case Kind::tangent:
      step.aux2[0] = (1 + step.constant * step.out[0] * step.out[0]);
      break;
    case Kind::hyperbolic:  // the other of the two
      step.out2[0] = (evaluate(step.constant > 0 ? Function::sinh : Function::cosh, step.operands[0][0]));
      break;
    default:
      break;
  }
}

void TaylorExpansion::start_rows() {
  for (const std::uint32_t slot : varying_slots_) {
    row(slot)[0] = workspace_[slot];
  }
  double* t = row(tape_.parameters_);
  t[1] = t[taylor::reversed - 1] = 1;
  for (const Step& step : steps_) start_auxiliary(step);
}

Evaluation TaylorExpansion::expand(double t, std::span<const double> y, unsigned order,
                                   std::span<double> coefficients) {
  const Evaluation evaluation = tape_.evaluate(t, y, workspace_, accelerations_);
  if (evaluation != Evaluation::ok) return evaluation;
  if (!factor()) return Evaluation::singular_mass;
  start_rows();
  kernel_(program_, order);
  for (std::size_t i = 0; i < y.size(); ++i) {
    std::copy_n(program_.state.rows[i], order + 1,
                coefficients.begin() + static_cast<std::ptrdiff_t>(i * (order + 1)));
  }
  return Evaluation::ok;
}

}  // namespace qdot
