#include "core/compile/taylor/pair_expansion.hpp"

#include <algorithm>

namespace qdot {
namespace {

PairWorkspace side_by_side(const Workspace& a, const Workspace& b) {
  PairWorkspace both(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) both[i] = PairOfDoubles{a[i], b[i]};
  return both;
}

}  // namespace

PairExpansion::PairExpansion(const TaylorExpansion& first, const TaylorExpansion& second)
    : tape_(first.tape_),
      kernels_(first.kernels_),
      workspace_(side_by_side(first.workspace_, second.workspace_)),
      accelerations_(tape_.outputs()),
      translation_(*first.translation_, *second.translation_, workspace_) {}

bool PairExpansion::expand(double t, std::span<const PairOfDoubles> y, unsigned order,
                           std::span<PairOfDoubles> coefficients) {
  if (!translation_.is_possible() || order > highest_order) return false;
  if (tape_.evaluate(t, y, workspace_, accelerations_) != Evaluation::ok) return false;
  if (!translation_.start()) return false;
  const taylor::PairProgram& program = translation_.program();
  kernels_.expand_pair(program, order);
  for (std::size_t i = 0; i < y.size(); ++i) {
    std::copy_n(program.state.rows + i * taylor::stride, order + 1,
                coefficients.begin() + static_cast<std::ptrdiff_t>(i * (order + 1)));
  }
  return true;
}

}  // namespace qdot
