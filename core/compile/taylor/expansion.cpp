#include "core/compile/taylor/expansion.hpp"

#include <algorithm>

#include "core/compile/taylor/translation.hpp"

namespace qdot {
namespace {

taylor::Kernel kernel_for(InstructionSet set) {
  return set == InstructionSet::automatic && __builtin_cpu_supports("avx2") ? taylor::avx2::expand
                                                                            : taylor::plain::expand;
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
      accelerations_(accelerations.outputs()),
      translation_(std::make_unique<TaylorTranslation>(tape_, workspace_)) {}

TaylorExpansion::~TaylorExpansion() = default;

Evaluation TaylorExpansion::expand(double t, std::span<const double> y, unsigned order,
                                   std::span<double> coefficients) {
  const Evaluation evaluation = tape_.evaluate(t, y, workspace_, accelerations_);
  if (evaluation != Evaluation::ok) return evaluation;
  if (!translation_->start(workspace_)) return Evaluation::singular_mass;
  const taylor::Program& program = translation_->program();
  kernel_(program, order);
  for (std::size_t i = 0; i < y.size(); ++i) {
    std::copy_n(program.state.rows + i * taylor::stride, order + 1,
                coefficients.begin() + static_cast<std::ptrdiff_t>(i * (order + 1)));
  }
  return Evaluation::ok;
}

}  // namespace qdot
