#include "core/compile/extended/translation.hpp"

namespace qdot {

using extended::Kind;
using extended::Step;

ExtendedTranslation::ExtendedTranslation(const ExtendedTape& tape)
    : function_(tape.function()),
      constants_(tape.slots()),
      time_(tape.time_slot()),
      varies_(constants_.size()),
      rows_used_(constants_.size()) {
  constexpr std::size_t most_rows_of_its_own = 6;  // of one instruction
  const std::size_t rows = constants_.size() + most_rows_of_its_own * function_.instructions().size();
  rows_.assign(rows * extended::row_length, 0.0);
  for (std::size_t slot = 0; slot < constants_.size(); ++slot) {
    if (slot >= time_ && slot <= time_ + function_.variables()) varies_[slot] = true;
  }
  for (std::size_t i = 1; i <= function_.variables(); ++i) state_.push_back(row(time_ + i));
  for (const Instruction& instruction : function_.instructions()) translate(instruction);
  for (const Slot slot : tape.outputs()) accelerations_.push_back(row(slot));
}

extended::Program ExtendedTranslation::program() const {
  return {steps_, {accelerations_.size(), state_.data(), accelerations_.data()}};
}

void ExtendedTranslation::translate(const Instruction& instruction) {
  const Slot* operand = function_.operands().data() + instruction.first;
  const double* x = row(operand[0]);
  double* out = row(instruction.out);
  varies_[instruction.out] = true;
  switch (instruction.operation) {
    case Operation::sum_of_products:
      return add_sum(instruction);
    case Operation::quotient:
      return add_quotient(x, row(operand[1]), out, 0);
    case Operation::power:
      return add_power(instruction);
    case Operation::square_root: {
      Step& step = steps_.emplace_back();
      step.kind = Kind::root;
      step.x = x;
      step.out = out;
      return;
    }
    case Operation::sine_cosine: {
      varies_[instruction.out + 1] = true;
      double* cosine = row(instruction.out + 1);
      const double* rate = rate_of(operand[0]);
      add_integral_of_product(1.0, rate, cosine, out);
      return add_integral_of_product(-1.0, rate, out, cosine);
    }
    case Operation::call:
      return add_call(instruction);
    case Operation::solve:
      return add_solve(instruction);
  }
}

/// Products with what is constant become terms; what is constant itself is in coefficient 0 only.
void ExtendedTranslation::add_sum(const Instruction& instruction) {
  const Slot* operand = function_.operands().data() + instruction.first;
  std::vector<extended::Term>& terms = terms_.emplace_back();
  std::vector<extended::Product>& products = products_.emplace_back();
  for (unsigned i = 0; i < instruction.linear; ++i, operand += 2) {
    if (varies(operand[1])) terms.push_back({constants_[operand[0]], row(operand[1])});
  }
  for (unsigned i = 0; i < instruction.products; ++i, operand += 3) {
    const DoubleDouble factor = constants_[operand[0]];
    const Slot x = operand[1], y = operand[2];
    if (varies(x) && varies(y)) {
      products.push_back({factor, row(x), row(y)});
    } else if (varies(x)) {
      terms.push_back({factor * constants_[y], row(x)});
    } else if (varies(y)) {
      terms.push_back({factor * constants_[x], row(y)});
    }
  }
  Step& step = steps_.emplace_back();
  step.kind = Kind::sum;
  step.terms = terms;
  step.products = products;
  step.out = row(instruction.out);
}

void ExtendedTranslation::add_product(const DoubleDouble& factor, const double* x, const double* y,
                                      double* out, unsigned lag) {
  std::vector<extended::Product>& products = products_.emplace_back();
  products.push_back({factor, x, y});
  Step& step = steps_.emplace_back();
  step.kind = Kind::sum;
  step.lag = lag;
  step.products = products;
  step.out = out;
}

void ExtendedTranslation::add_integral(const DoubleDouble& factor, const double* x, double* out) {
  Step& step = steps_.emplace_back();
  step.kind = Kind::integral;
  step.factor = factor;
  step.x = x;
  step.out = out;
}

void ExtendedTranslation::add_integral_of_product(const DoubleDouble& factor, const double* x,
                                                  const double* y, double* out) {
  double* product = own_row(Start::none);
  add_product(1.0, x, y, product, 1);
  add_integral(factor, product, out);
}

void ExtendedTranslation::add_quotient(const double* x, const double* y, double* out, unsigned lag) {
  Step& step = steps_.emplace_back();
  step.kind = Kind::quotient;
  step.lag = lag;
  step.x = x;
  step.y = y;
  step.out = out;
}

double* ExtendedTranslation::own_row(Start start, const double* x, Function function) {
  double* result = row(rows_used_++);
  own_rows_.push_back({result, start, x, function});
  return result;
}

/// The row of a coordinate's rate is that of its velocity.
const double* ExtendedTranslation::rate_of(Slot slot) {
  const std::size_t n = function_.variables() / 2;
  if (slot > time_ && slot <= time_ + n) return row(slot + n);
  double* rate = own_row(Start::none);
  Step& step = steps_.emplace_back();
  step.kind = Kind::rate;
  step.lag = 1;
  step.x = row(slot);
  step.out = rate;
  return rate;
}

void ExtendedTranslation::add_call(const Instruction& instruction) {
  const Slot u = function_.operands()[instruction.first];
  double* out = row(instruction.out);
  switch (instruction.function) {
    case Function::exp:
      add_integral_of_product(1.0, rate_of(u), out, out);
      steps_.back().argument = row(u);
      return;
    case Function::log: {
      double* rate = own_row(Start::none);
      add_quotient(rate_of(u), row(u), rate, 1);
      return add_integral(1.0, rate, out);
    }
    case Function::tan:
    case Function::tanh:
      return add_tangent(instruction);
    case Function::sinh:
    case Function::cosh: {
      const Function other = instruction.function == Function::sinh ? Function::cosh : Function::sinh;
      double* partner = own_row(Start::function, row(u), other);
      const double* rate = rate_of(u);
      add_integral_of_product(1.0, rate, partner, out);
      return add_integral_of_product(1.0, rate, out, partner);
    }
    case Function::asin:
    case Function::acos:
    case Function::atan:
      return add_arc(instruction);
    case Function::sin:
    case Function::cos:
    case Function::abs:
    case Function::sign:
      break;  // has_extended_expansion() says no; sine and cosine are an operation of their own
  }
}

/// p = c u' z, then z' = p/u.
void ExtendedTranslation::add_power(const Instruction& instruction) {
  const Slot* operand = function_.operands().data() + instruction.first;
  double* z = row(instruction.out);
  double* product = own_row(Start::none);
  add_product(constants_[operand[1]], rate_of(operand[0]), z, product, 1);
  double* rate = own_row(Start::none);
  add_quotient(product, row(operand[0]), rate, 1);
  add_integral(1.0, rate, z);
}

/// z' = u' w with w = 1 + z^2, of the hyperbolic one 1 - z^2.
void ExtendedTranslation::add_tangent(const Instruction& instruction) {
  const Slot u = function_.operands()[instruction.first];
  double* z = row(instruction.out);
  const bool is_hyperbolic = instruction.function == Function::tanh;
  // 1 - tanh^2 u cancels, and 1/cosh^2 u does not.
  double* w =
      is_hyperbolic ? own_row(Start::inverse_square_of_cosh, row(u)) : own_row(Start::one_plus_square, z);
  add_integral_of_product(1.0, rate_of(u), w, z);
  if (is_hyperbolic) steps_.back().argument = row(u);
  add_product(is_hyperbolic ? -1.0 : 1.0, z, z, w, 0);
}

/// z' = u'/w with w = 1 + u^2, or the root of 1 - u^2.
void ExtendedTranslation::add_arc(const Instruction& instruction) {
  const Slot u = function_.operands()[instruction.first];
  const bool is_atan = instruction.function == Function::atan;
  double* w = own_row(is_atan ? Start::one_plus_square : Start::one_minus_square, row(u));
  add_product(is_atan ? 1.0 : -1.0, row(u), row(u), w, 0);
  if (!is_atan) {
    double* root = own_row(Start::square_root, w);
    Step& step = steps_.emplace_back();
    step.kind = Kind::root;
    step.x = w;
    step.out = root;
    w = root;
  }
  double* rate = own_row(Start::none);
  add_quotient(rate_of(u), w, rate, 1);
  add_integral(instruction.function == Function::acos ? -1.0 : 1.0, rate, row(instruction.out));
}

void ExtendedTranslation::add_solve(const Instruction& instruction) {
  const Slot* operand = function_.operands().data() + instruction.first;
  const std::size_t n = instruction.linear;
  for (std::size_t i = 0; i < n; ++i) varies_[instruction.out + i] = true;
  if (n == 1) return add_quotient(row(operand[1]), row(operand[0]), row(instruction.out), 0);
  LinearSystem& system = systems_.emplace_back();
  system.has_determinant = instruction.has_determinant;
  if (instruction.has_determinant) system.determinant_slot = *operand++;
  system.matrix_slots.assign(operand, operand + n * n);
  for (const Slot slot : system.matrix_slots) system.matrix.push_back(varies(slot) ? row(slot) : nullptr);
  for (std::size_t i = 0; i < n; ++i) {
    system.right.push_back(row(operand[n * n + i]));
    system.unknowns.push_back(row(instruction.out + i));
  }
  system.inverse.resize(n * n);
  Step& step = steps_.emplace_back();
  step.kind = Kind::solve;
  step.system = &views_.emplace_back(extended::System{n, system.matrix.data(), system.right.data(),
                                                      system.unknowns.data(), system.inverse.data()});
}

}  // namespace qdot
