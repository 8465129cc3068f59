#pragma once
// The equations of one step of Gauss's collocation method with three stages.
//
//   Z_i = z + h sum_j a_ij F_j,   F_j = f(t + c_j h, Z_j),   z(t + h) = z + h sum_j b_j F_j
//   c = 1/2 - s/10, 1/2, 1/2 + s/10,   b = 5/18, 8/18, 5/18,   s = sqrt(15)
// Order 6, A-stable, time-reversible, and symplectic because b_i a_ij + b_j a_ji = b_i b_j. Sources: Hairer,
// Lubich, Wanner, Geometric Numerical Integration, 2nd ed., II.1.3 (the method),
// VI.4 (symplecticity), VIII.6 (iteration).
//
// Rounded coefficients would make the energy drift (Hairer, McLachlan, Razakarivony, BIT 48 (2008) 231).
// Written as a_ij = b_j/2 + r m_ij with r = s/120 and whole numbers m_ij, they fulfil the condition exactly
// whatever r is rounded to, and the 18 of b only changes h in its last digit.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/integrate/evaluator.hpp"

namespace qdot {

inline constexpr std::size_t gauss_stages = 3;

class GaussStages {
 public:
  [[nodiscard]] static const std::array<double, gauss_stages>& nodes();

  /// Where a step begins: at z + carried, where `carried` is what rounding has taken from z.
  struct Beginning {
    double t{};
    std::span<const double> z{};
    std::span<const double> carried{};
  };

  /// Keeps the reference. Without a Jacobian only the fixed-point iteration is tried.
  GaussStages(Evaluator& evaluator, std::size_t dimension, bool has_jacobian);

  /// The slopes F (stages x dimension, row-major) of a step of length h, solved for until only round-off
  /// changes them; on entry a guess. By fixed-point iteration, and by Newton's iteration from the first step
  /// on where that does not contract. answer_retry: no solution was found.
  [[nodiscard]] Answer solve(const Beginning& begin, double h, std::span<double> slopes);

  /// h sum_j b_j F_j of component i.
  [[nodiscard]] double rise(double h, std::span<const double> slopes, std::size_t i) const;

 private:
  enum class State { going, settled, lost };
  /// How the iteration of one component goes: its last changes, those of even and of odd iterations apart,
  /// and whether either has stopped falling because only round-off goes on.
  struct Component {
    std::array<double, 2> last{};
    std::array<bool, 2> ended{};
  };

  [[nodiscard]] Answer iterate_fixed_point(const Beginning& begin, double h, std::span<double> slopes);
  [[nodiscard]] Answer iterate_newton(const Beginning& begin, double h, std::span<double> slopes);
  [[nodiscard]] Answer evaluate(const Beginning& begin, double h, std::span<double> slopes);
  /// Z_j, which lies in stage_.
  void set_stage(const Beginning& begin, std::size_t j);
  /// attempt_ := h sum_j a_ij F_j for all i.
  void set_attempt(double h, std::span<const double> slopes);

  void start_watching();
  /// Makes the attempt the iterate and tells from how much it changed whether round-off is reached.
  [[nodiscard]] State take_attempt(const Beginning& begin);
  /// Component i's change, over the component's size; `change` in the component's own unit.
  [[nodiscard]] double watch(std::size_t i, double change, double largest_size);

  Evaluator& evaluator_;
  std::size_t n_;
  bool has_jacobian_;
  bool newton_{false};              ///< the fixed-point iteration has failed once
  std::vector<double> increments_;  ///< Z_i - z
  std::vector<double> attempt_, stage_, sizes_;
  std::vector<Component> components_;
  unsigned iterations_{};
  double least_change_{};
};

}  // namespace qdot
