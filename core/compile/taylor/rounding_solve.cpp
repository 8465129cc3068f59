#include <algorithm>
#include <array>
#include <cmath>

#include "core/compile/taylor/rounding.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/linear_system.hpp"

namespace qdot::taylor {

double Rounding::of_entry(Slot m, std::size_t unknowns) const {
  return sizes_[m].error + static_cast<double>(unknowns) * of_functions() * sizes_[m].most;
}

/// The largest p of `first` that dM makes of it, as the remainder has it; M's slots are given. What in it is
/// so small that its parts underflow becomes larger, and so does a zero, of which nothing is a part.
double Rounding::part_made_again(const Instruction& instruction, const Slot* m,
                                 std::span<double> first) const {
  const std::size_t n = first.size();
  constexpr double small = 1.0 / 16, above_underflow = 1e-280;
  double part = 0;
  for (std::size_t j = 0; j < n; ++j) {
    if (first[j] > 0) part = std::max(part, first[j] / sizes_[instruction.out + j].most);
  }
  if (part < small) return part;  // for rho holds |dM| |x|
  for (double& one : first) one = std::max(one, above_underflow);
  std::array<double, largest_system> rho{}, again{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) rho[i] += of_entry(m[i * n + j], n) * first[j];
  }
  remainder_.bound_solution_of(rows_[instruction.out], std::span(rho).first(n), std::span(again).first(n));
  part = 0;
  for (std::size_t j = 0; j < n; ++j) {
    if (again[j] > 0) part = std::max(part, again[j] / first[j]);
  }
  return part;
}

/// M x = f, where M may be off by dM: what f - M x may be off by, rho, changes x by e_1 as the remainder has
/// it. But dM acts on that change, too: e <= e_1 + |M^-1| |dM| e, and so e <= e_1/(1 - p) where it makes of
/// e_1 no more than p e_1.
void Rounding::apply_solve(const Instruction& instruction, const Slot* operand) {
  const std::size_t n = instruction.linear;
  if (n == 1) {
    sizes_[instruction.out] = quotient(operand[1], operand[0], instruction.out);
    return;
  }
  double of_determinant = 0;
  if (instruction.has_determinant) {
    const Slot determinant = *operand++;
    of_determinant = sizes_[determinant].error / std::abs(slots_[determinant]);
  }
  for (std::size_t j = 0; j < n; ++j) {
    const auto out = static_cast<Slot>(instruction.out + j);
    sizes_[out].most = most(out, infinity);
  }
  std::array<double, largest_system> rho{}, first{};
  for (std::size_t i = 0; i < n; ++i) {
    rho[i] = sizes_[operand[n * n + i]].error;
    for (std::size_t j = 0; j < n; ++j)
      rho[i] += of_entry(operand[i * n + j], n) * sizes_[instruction.out + j].most;
  }
  remainder_.bound_solution_of(rows_[instruction.out], std::span(rho).first(n), std::span(first).first(n));
  const double part = part_made_again(instruction, operand, std::span(first).first(n));
  const bool is_bounded = part < 1 && of_determinant < 1;
  for (std::size_t j = 0; j < n; ++j) {
    Size& x = sizes_[instruction.out + j];
    const double error = (first[j] + of_determinant * x.most) / ((1 - part) * (1 - of_determinant));
    x.error = is_bounded && !std::isnan(error) ? error : infinity;
  }
}

}  // namespace qdot::taylor
