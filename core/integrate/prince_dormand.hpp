#pragma once
// The explicit Runge-Kutta pair RK8(7)13M of Prince and Dormand: order 8, embedded error estimate of order 7.
//
//   k_i = f(t + c_i h, y + h sum_{j<i} a_ij k_j)
//   y(t + h) = y + h sum_i b_i k_i
//   error = h sum_i (b_i - d_i) k_i
//
// Source: P. J. Prince, J. R. Dormand, High order embedded Runge-Kutta formulae, J. Comp. Appl. Math. 7
// (1981) 67-75, Table 2. All 200 order conditions up to order 8 (115 of them of order 8 itself), and the 85
// up to order 7 for d, hold to 1e-14 with these numbers.
//
// Why not ARKODE's own Fehlberg 7(8): its error estimate, 41/840 (k_1 + k_11 - k_12 - k_13) with c = 0, 1, 0,
// 1, is identically zero for y' = f(t), so that a cart pushed by a force F(t) would be integrated blindly.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/integrate/evaluator.hpp"

namespace qdot {

struct PrinceDormand {
  static constexpr int order = 8;
  static constexpr int embedded_order = 7;
  static constexpr std::size_t stages = 13;

  static const std::array<double, stages> c;
  static const std::array<std::array<double, stages>, stages> a;  ///< strictly lower triangular
  static const std::array<double, stages> b;                      ///< order 8
  static const std::array<double, stages> d;                      ///< order 7
};

/// Dense output of full order: y(t_n + h) by one step of any length h from one base point (t_n, y_n). An
/// interpolating polynomial of lower degree would spoil what the method earned.
class RungeKuttaFan {
 public:
  RungeKuttaFan(Evaluator& evaluator, std::size_t dimension);

  void set_base(double t, std::span<const double> y);

  /// Costs 12 evaluations, and one more for the first h of a base.
  [[nodiscard]] Answer advance(double h, std::span<double> y_out);

 private:
  void combine(std::span<const double> weights, double h, std::span<double> y_out) const;

  Evaluator& evaluator_;
  double t_{};
  std::vector<double> y_;
  std::vector<double> stage_;                                      ///< y + h sum a_ij k_j
  std::array<std::vector<double>, PrinceDormand::stages> slopes_;  ///< k_i
  bool first_slope_known_{false};
};

}  // namespace qdot
