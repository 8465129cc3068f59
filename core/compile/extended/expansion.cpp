#include "core/compile/extended/expansion.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/compile/extended/translation.hpp"
#include "core/numerics/instruction_set.hpp"

namespace qdot {
namespace {

extended::Kernel extended_kernel_for(InstructionSet set) {
  return set == InstructionSet::automatic && has_avx2_and_fma() ? extended::fma::expand
                                                                : extended::plain::expand;
}

std::vector<double> high_parts(std::span<const DoubleDouble> values) {
  std::vector<double> result;
  for (const DoubleDouble& value : values) result.push_back(value.high);
  return result;
}

}  // namespace

bool has_extended_expansion(const CompiledFunction& accelerations) {
  return std::ranges::none_of(accelerations.instructions(), [](const Instruction& i) {
    const bool is_kink = i.function == Function::abs || i.function == Function::sign;
    return (i.operation == Operation::call && is_kink) || (i.operation == Operation::solve && i.products > 1);
  });
}

ExtendedExpansion::ExtendedExpansion(const CompiledFunction& accelerations,
                                     std::span<const DoubleDouble> parameters, InstructionSet instruction_set)
    : tape_(accelerations, parameters),
      kernel_(extended_kernel_for(instruction_set)),
      translation_(std::make_unique<ExtendedTranslation>(tape_)) {
  if (!has_extended_expansion(accelerations)) throw std::invalid_argument("a kink has no expansion");
}

ExtendedExpansion::~ExtendedExpansion() = default;

Evaluation ExtendedExpansion::expand(const DoubleDouble& t, std::span<const DoubleDouble> y, unsigned order,
                                     std::span<DoubleDouble> coefficients) {
  const Evaluation evaluation = tape_.evaluate(t, y);
  if (evaluation != Evaluation::ok) return evaluation;
  if (!translation_->start(tape_, order)) return Evaluation::singular_mass;
  const extended::Program program = translation_->program();
  kernel_(program, order);
  std::size_t next = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double* row = program.state.rows[i];
    for (unsigned k = 0; k <= order; ++k) coefficients[next++] = {row[k], row[extended::run_length + k]};
  }
  return Evaluation::ok;
}

MixedExpansion::MixedExpansion(const CompiledFunction& accelerations,
                               std::span<const DoubleDouble> parameters)
    : first_(accelerations, parameters), others_(accelerations, high_parts(parameters)) {}

Evaluation MixedExpansion::expand_in_doubles(double t, std::span<const double> y, unsigned order) {
  order_ = order;
  is_expanded_ = false;
  other_coefficients_.resize(y.size() * (order + 1));
  const Evaluation evaluation = others_.expand(t, y, order, other_coefficients_);
  if (evaluation != Evaluation::ok) return evaluation;
  t_ = t;
  is_expanded_ = true;
  return evaluation;
}

Evaluation MixedExpansion::expand(const DoubleDouble& t, std::span<const DoubleDouble> y, unsigned order,
                                  std::span<DoubleDouble> coefficients) {
  const unsigned low_order = std::min(order, first_in_doubles - 1);
  first_coefficients_.resize(y.size() * (low_order + 1));
  const Evaluation evaluation = first_.expand(t, y, low_order, first_coefficients_);
  if (evaluation != Evaluation::ok) return evaluation;
  y_.resize(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) y_[i] = y[i].high;
  const Evaluation other = expand_in_doubles(t.high, y_, order);
  if (other != Evaluation::ok) return other;
  for (std::size_t i = 0; i < y.size(); ++i) {
    DoubleDouble* row = coefficients.data() + i * (order + 1);
    const DoubleDouble* first = first_coefficients_.data() + i * (low_order + 1);
    const double* others = other_coefficients_.data() + i * (order + 1);
    row = std::copy_n(first, low_order + 1, row);
    for (unsigned k = low_order + 1; k <= order; ++k) *row++ = others[k];
  }
  return Evaluation::ok;
}

double MixedExpansion::bound_defect(double t, std::span<const double> y, double h,
                                    std::span<const double> allowed, std::span<double> defect) {
  if (!is_expanded_ || t != t_ || !std::ranges::equal(y, y_)) {
    y_.assign(y.begin(), y.end());
    if (expand_in_doubles(t, y_, order_) != Evaluation::ok) return std::numeric_limits<double>::infinity();
  }
  return others_.bound_defect(h, allowed, defect);
}

}  // namespace qdot
