#include "core/compile/taylor/expansion.hpp"

#include <algorithm>

#include "core/compile/taylor/translation.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/instruction_set.hpp"

namespace qdot {

taylor::Kernels taylor::best_kernels() {
  return has_avx2() ? Kernels{avx2::expand, avx2::expand_pair, avx2::measure} : plain_kernels();
}

taylor::Kernels taylor::plain_kernels() { return {plain::expand, plain::expand_pair, plain::measure}; }

TaylorExpansion::TaylorExpansion(const CompiledFunction& accelerations, std::span<const double> parameters,
                                 InstructionSet instruction_set)
    : tape_(accelerations),
      kernels_(instruction_set == InstructionSet::plain ? taylor::plain_kernels() : taylor::best_kernels()),
      workspace_(accelerations.bind(parameters)),
      accelerations_(accelerations.outputs()),
      translation_(std::make_unique<TaylorTranslation>(tape_, workspace_, accelerations.outputs())) {}

TaylorExpansion::~TaylorExpansion() = default;

Evaluation TaylorExpansion::expand(double t, std::span<const double> y, unsigned order,
                                   std::span<double> coefficients) {
  const Evaluation evaluation = tape_.evaluate(t, y, workspace_, accelerations_);
  if (evaluation != Evaluation::ok) return evaluation;
  if (!translation_->start(workspace_)) return Evaluation::singular_mass;
  const taylor::Program& program = translation_->program();
  kernels_.expand(program, order);
  order_ = order;
  for (std::size_t i = 0; i < y.size(); ++i) {
    std::copy_n(program.state.rows + i * taylor::stride, order + 1,
                coefficients.begin() + static_cast<std::ptrdiff_t>(i * (order + 1)));
  }
  return Evaluation::ok;
}

double TaylorExpansion::bound_defect(double h, std::span<const double> allowed, std::span<double> defect) {
  if (!allowed.empty()) return remainder().bound(h, order_, allowed, defect);
  remainder().closest(h, order_, defect);
  return infinity;
}

void TaylorExpansion::find_ranges(double h) { remainder().find_ranges(h, order_); }

taylor::Remainder& TaylorExpansion::remainder() {
  if (!remainder_) remainder_ = std::make_unique<taylor::Remainder>(translation_->program(), kernels_);
  return *remainder_;
}

void TaylorExpansion::bound_rounding(std::span<double> rounding, double unit) {
  if (!rounding_) {
    const auto row_of = [this](Slot slot) { return translation_->row_of(slot); };
    rounding_ = std::make_unique<taylor::Rounding>(tape_, workspace_, *remainder_, row_of);
  }
  rounding_->bound(unit, rounding);
}

}  // namespace qdot
