#include "core/compile/taylor/rounding.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/ball.hpp"

namespace qdot::taylor {
namespace {

constexpr double last_digits = 64;  ///< units: bounds add up what mostly goes to and fro
constexpr double of_underflow = 0x1p-1074;
constexpr double large =
    100;  ///< what such numbers are off may matter relatively alone: exp of them overflows

double known_or_infinite(double x) { return std::isnan(x) ? infinity : x; }

bool is_power_of_two(double x) {
  int exponent{};
  return std::abs(std::frexp(x, &exponent)) == 0.5;
}

/// e^e - 1: by what factor exp changes where its argument does by e.
double growth(double e) { return e < 1 ? e * (1 + e) : evaluate(Function::exp, e); }

/// How much larger the terms of a series are than its values; where these overflow there are no others.
double spread(double most, double least) { return most / least > 1 ? most / least : 1; }

/// |x| of a product or sum with its error, term by term.
struct RunningSum {
  double unit{};
  double most{}, error{};
  bool is_first{true};

  void add(double size, double e) {
    most += size;
    error += e;
    if (!is_first) error += unit * most;
    is_first = false;
  }
};

}  // namespace

Rounding::Rounding(const CompiledFunction& tape, const Workspace& slots, const Remainder& remainder,
                   const RowOf& row_of)
    : tape_(tape),
      slots_(slots),
      remainder_(remainder),
      rows_(tape.slots_, no_row),
      varies_(tape.slots_),
      is_power_of_two_(tape.slots_),
      is_asked_relatively_(tape.slots_),
      sizes_(tape.slots_),
      in_doubles_(tape.slots_) {
  for (Slot slot = 0; slot < rows_.size(); ++slot) {
    const auto found = remainder.indices_.find(row_of(slot));
    if (found != remainder.indices_.end()) rows_[slot] = found->second;
  }
  for (std::size_t i = 0; i <= tape.variables_; ++i) varies_[tape.parameters_ + i] = true;
  for (const Instruction& i : tape.body_) {
    const std::size_t results = i.operation == Operation::solve         ? i.linear
                                : i.operation == Operation::sine_cosine ? 2
                                                                        : 1;
    for (std::size_t k = 0; k < results; ++k) varies_[i.out + k] = true;
    const bool is_root = i.operation == Operation::square_root || i.operation == Operation::power;
    if (is_root) is_asked_relatively_[tape.operands_[i.first]] = true;
  }
  take_constants();
}

/// What depends on parameters alone, by balls that hold it.
void Rounding::take_constants() {
  const auto parameters = std::span(slots_).first(tape_.parameters_);
  const TapeEvaluator<Ball> exact(tape_, std::vector<Ball>(parameters.begin(), parameters.end()));
  for (Slot slot = 0; slot < rows_.size(); ++slot) {
    if (varies_[slot]) continue;
    is_power_of_two_[slot] = is_power_of_two(slots_[slot]);
    const bool is_parameter = slot < tape_.parameters_;
    const Ball off = is_parameter ? Ball(0.0) : exact.slots()[slot] - Ball(slots_[slot]);
    sizes_[slot] = {std::abs(slots_[slot]), known_or_infinite(off.magnitude())};
    in_doubles_[slot] = sizes_[slot].error;
  }
  for (const auto& [slot, value] : tape_.literals_) {  // balls may not hold small ones as closely
    double& error = sizes_[slot].error;
    in_doubles_[slot] = error = std::min(error, half_unit_of_doubles * sizes_[slot].most + of_underflow);
  }
}

void Rounding::take_variables() {
  const auto time = static_cast<Slot>(tape_.parameters_);
  sizes_[time] = {std::abs(slots_[time]) + remainder_.h_, 0};
  waiting_.clear();
  for (Slot i = 0; i < tape_.variables_; ++i) {
    const Slot slot = time + 1 + i;
    sizes_[slot] = {most(slot, 0), 0};
    if (rows_[slot] != no_row && measured(slot) == nullptr) waiting_.push_back(slot);
  }
  for (std::size_t i = 0; i < waiting_.size(); i += 2) {
    const Slot first = waiting_[i], second = waiting_[std::min(i + 1, waiting_.size() - 1)];
    const std::array<double, 2> sums = remainder_.sums_of_sizes(rows_[first], rows_[second]);
    sizes_[first].most = sums[0];
    sizes_[second].most = sums[1];
  }
}

/// A constant that happens to be near to a double need not be as near to a double-double.
void Rounding::take_unit(double unit) {
  unit_ = unit;
  for (Slot slot = 0; slot < sizes_.size(); ++slot) {
    if (varies_[slot]) continue;
    const double in_doubles = in_doubles_[slot];
    const bool is_other = unit != half_unit_of_doubles && in_doubles > 0;
    const double scaled = in_doubles * (unit / half_unit_of_doubles);
    sizes_[slot].error = is_other ? std::max(scaled, unit * sizes_[slot].most) : in_doubles;
  }
}

void Rounding::bound(double unit, std::span<double> accelerations) {
  if (unit != unit_) take_unit(unit);
  take_variables();
  for (const Instruction& instruction : tape_.body_) apply(instruction);
  const std::size_t n = accelerations.size();
  const auto put = [&](std::size_t i, double size) {
    const double beyond = sizes_[tape_.outputs_[i]].error - last_digits * unit_ * (size / remainder_.h_);
    accelerations[i] = known_or_infinite(std::max(beyond, 0.0));
  };
  const std::span<const Remainder::Index> velocities = std::span(remainder_.state_).subspan(remainder_.n_, n);
  for (std::size_t i = 0; i < n; i += 2) {
    const std::size_t next = std::min(i + 1, n - 1);
    const std::array<double, 2> sizes = remainder_.sums_of_slopes(velocities[i], velocities[next]);
    put(i, sizes[0]);
    put(next, sizes[1]);
  }
}

double Rounding::of_output() {
  take_variables();
  for (const Instruction& instruction : tape_.body_) apply(instruction);
  return known_or_infinite(sizes_[tape_.outputs_.front()].error);
}

const Remainder::Row* Rounding::measured(Slot slot) const {
  if (rows_[slot] == no_row) return nullptr;
  const Remainder::Row& row = remainder_.rows_[rows_[slot]];
  return row.is_factor || remainder_.effort_ == Remainder::Effort::careful ? &row : nullptr;
}

bool Rounding::is_at_start_alone(Slot slot) const {
  return rows_[slot] == no_row && slot > tape_.parameters_ + tape_.variables_;
}

double Rounding::most(Slot slot, double otherwise) const {
  if (is_at_start_alone(slot)) return std::abs(slots_[slot]);
  const Remainder::Row* row = measured(slot);
  return row == nullptr ? otherwise : row->t0 + row->r;
}

Range Rounding::values(Slot slot) const {
  if (!varies_[slot] || is_at_start_alone(slot)) return {slots_[slot], slots_[slot]};
  const Remainder::Row* row = measured(slot);
  return row == nullptr ? Range{-sizes_[slot].most, sizes_[slot].most} : row->of_value;
}

void Rounding::apply(const Instruction& instruction) {
  const Slot* operand = tape_.operands_.data() + instruction.first;
  Size& out = sizes_[instruction.out];
  switch (instruction.operation) {
    case Operation::sum_of_products:
      out = sum(instruction, operand);
      break;
    case Operation::quotient:
      out = quotient(operand[0], operand[1], instruction.out);
      break;
    case Operation::power:
      out = power(instruction, operand);
      break;
    case Operation::square_root:
      out = root(operand[0], instruction.out);
      break;
    case Operation::sine_cosine:
      return apply_sine_cosine(instruction, operand[0]);
    case Operation::call:
      out = function(instruction, operand[0]);
      break;
    case Operation::solve:
      return apply_solve(instruction, operand);
  }
  out.error += of_underflow;
}

double Rounding::relative(Slot slot) const {
  const Size& size = sizes_[slot];
  const double by_least = size.error == 0 ? 0 : size.error / (least(slot) - size.error);
  return by_least >= 0 ? std::min(by_least, size.relative) : size.relative;
}

Rounding::Size Rounding::sum(const Instruction& instruction, const Slot* operand) const {
  RunningSum total{.unit = unit_};
  const Slot* const first = operand;
  for (unsigned k = 0; k < instruction.linear; ++k, operand += 2) {
    const Size &c = sizes_[operand[0]], &x = sizes_[operand[1]];
    const double size = c.most * x.most, once = is_power_of_two_[operand[0]] ? 0 : unit_;
    total.add(size, c.most * x.error + c.error * (x.most + x.error) + once * size);
  }
  for (unsigned k = 0; k < instruction.products; ++k, operand += 3) {
    const Size &c = sizes_[operand[0]], &x = sizes_[operand[1]], &y = sizes_[operand[2]];
    const double xy = x.most * y.most, size = c.most * xy;
    const double of_xy = x.most * y.error + (y.most + y.error) * x.error;
    const double roundings = is_power_of_two_[operand[0]] ? unit_ : 2 * unit_;
    total.add(size, c.most * of_xy + c.error * (xy + of_xy) + roundings * size);
  }
  Size result{most(instruction.out, total.most), total.error};
  if (is_asked_relatively_[instruction.out] || !(total.most < large))
    result.relative = relative_of_sum(instruction, first);
  return result;
}

/// What terms are off relatively, where all have one sign, as squares do.
double Rounding::relative_of_sum(const Instruction& instruction, const Slot* operand) const {
  const unsigned terms = instruction.linear + instruction.products;
  double largest = 0;
  int sign = 0;
  for (unsigned k = 0; k < terms; ++k) {
    const unsigned factors = k < instruction.linear ? 2 : 3;
    double of_term = 0;
    int sign_of_term = 1;
    for (unsigned j = 0; j < factors; ++j, ++operand) {
      const double of_factor = relative(*operand) + unit_;
      of_term += of_factor + of_term * of_factor;
      const bool is_of_square = j > 0 && factors == 3 && operand[j == 1 ? 1 : -1] == *operand;
      const Range factor = values(*operand);
      sign_of_term *= is_of_square || factor.lower > 0 ? 1 : factor.upper < 0 ? -1 : 0;
    }
    if (terms > 1 && (sign_of_term == 0 || sign_of_term == -sign)) return infinity;
    sign = sign_of_term;
    largest = std::max(largest, of_term);
  }
  return largest + terms * unit_ * (1 + largest);
}

/// w = x/y by w y = x, whose terms are rounded.
Rounding::Size Rounding::quotient(Slot x, Slot y, Slot out) const {
  const double of_divisor = relative(y), divisor = least(y) * (1 - of_divisor);
  if (!(divisor > 0)) return {most(out, infinity), infinity};
  const double w = most(out, sizes_[x].most / divisor);
  const double of_terms = of_functions() * spread(sizes_[y].most, divisor);
  const double error = sizes_[x].error / divisor + w * (of_divisor / (1 - of_divisor) + of_terms);
  const double apart = w + (sizes_[x].most + sizes_[x].error) / divisor;  // both are no larger
  const double relatively = (relative(x) + of_divisor + 2 * of_functions()) / (1 - of_divisor);
  return {w, error < apart ? error : apart, relatively};
}

/// d(x^p) = p x^p dx/x + x^p log x dp
Rounding::Size Rounding::power(const Instruction& instruction, const Slot* operand) const {
  const double x = sizes_[operand[0]].most, of_x = relative(operand[0]);
  const double p = sizes_[operand[1]].most, of_p = sizes_[operand[1]].error;
  const double w = most(instruction.out, infinity), base = least(operand[0]);
  const double by_base = p * (of_x + of_functions() * spread(x, base)) / (1 - of_x);
  if (!(by_base >= 0)) return {w, infinity};
  double relative = growth(by_base) + of_functions();
  if (of_p > 0) {
    const double log_of_least = std::abs(evaluate(Function::log, base));
    relative += of_p * std::max(log_of_least, std::abs(evaluate(Function::log, x)));
  }
  return {w, w * relative, relative};
}

Rounding::Size Rounding::exponential(Slot x, Slot out) const {
  const double w = most(out, infinity), of_value = growth(sizes_[x].error) + 2 * of_functions();
  if (std::isfinite(of_value)) return {w, w * of_value, of_value};
  const double largest = values(x).upper, of_x = relative(x);  // exp(-cosh(y)) of a large y is 0 all the same
  if (!(largest < 0) || !(of_x < 1)) return {w, infinity};
  return {w, w + evaluate(Function::exp, largest * (1 - of_x))};
}

Rounding::Size Rounding::root(Slot x, Slot out) const {
  const double w = most(out, infinity);
  const double relatively = relative(x) + of_functions();
  const double error = (sizes_[x].error + of_functions() * w * w) / least(out);
  return {w, error < w * relatively ? error : w * relatively, relatively};
}

void Rounding::apply_sine_cosine(const Instruction& instruction, Slot x) {
  Size &sin = sizes_[instruction.out], &cos = sizes_[instruction.out + 1];
  const double at_most_one = 1;
  sin.most = most(instruction.out, at_most_one);
  cos.most = most(instruction.out + 1, at_most_one);
  sin.error = cos.error = std::min(sizes_[x].error, 2.0) + of_functions() * (sin.most + cos.most);
}

Rounding::Size Rounding::function(const Instruction& instruction, Slot x) const {
  const double e = sizes_[x].error, w = most(instruction.out, infinity);
  const auto with_slope = [&](double slope, double rounding) -> Size {
    return {w, known_or_infinite(slope * e) + rounding};
  };
  switch (instruction.function) {
    case Function::exp:
      return exponential(x, instruction.out);
    case Function::log: {
      const double base = least(x) - e;
      return base > 0 ? with_slope(1 / base, of_functions() * (w + w * sizes_[x].most / base))
                      : Size{w, infinity};
    }
    case Function::tan:
      return with_slope(1 + w * w, 2 * of_functions() * w * (1 + w));
    case Function::tanh: {
      const double cosh = evaluate(Function::cosh, std::max(0.0, least(x) - e));
      return with_slope(1 / (cosh * cosh), 2 * of_functions() * (1 + w));
    }
    case Function::atan: {
      const double nearest = std::max(0.0, least(x) - e);
      return with_slope(1 / (1 + nearest * nearest), 2 * of_functions() * (1 + w));
    }
    case Function::sinh: {
      const double of_steep = growth(2 * e) + 2 * of_functions();  // |coth| < 2 where |x| > 1
      const double error = (1 + w) * growth(e) + 2 * of_functions() * (1 + w);
      return {w, error, least(x) - e > 1 ? of_steep : infinity};
    }
    case Function::cosh:
      return {w, w * (growth(e) + 2 * of_functions()), growth(e) + 2 * of_functions()};
    case Function::asin:
    case Function::acos: {
      const double u = values(x).magnitude() + e, left = (1 - u) * (1 + u);
      const double slope = left > 0 ? 1 / std::sqrt(left) : infinity;
      return with_slope(slope, of_functions() * (w + 1 + slope * slope * slope));
    }
    case Function::abs:
      return {most(instruction.out, sizes_[x].most), e};
    case Function::sign:
      return {1, least(x) > e ? 0.0 : 2.0};
    case Function::sin:
    case Function::cos:
      break;  // a tape has them together
  }
  return {w, infinity};
}

}  // namespace qdot::taylor
