#pragma once
// The equations of motion in canonical variables z = (q, p), compiled.
//
//   p = dL/dq' = A(q,t) q' + a(q,t)          G(q, q', t) = A q' + a
//   q' = A^-1 (p - a)
//   p' = dL/dq + Q                           F(q, q', t) = dL/dq + Q
//   dq'/dz = A^-1 [-dG/dq, 1]
//   dp'/dz = [dF/dq, 0] + dF/dq' dq'/dz
// Where Q = 0 this is Hamilton's flow, and dz(t)/dz(0) is a symplectic matrix. Source: Goldstein, Classical
// Mechanics, 3rd ed., 8.1.

#include <memory>
#include <span>

#include "core/compile/compiled_function.hpp"
#include "core/mechanics/lagrangian.hpp"

namespace qdot {

class CanonicalFunctions {
 public:
  /// For Lagrangians of the same parameters, with t and z = (q, p) as variables.
  CanonicalFunctions(std::size_t n, CompiledFunction momenta, CompiledFunction derivative,
                     CompiledFunction derivatives)
      : n_(n),
        momenta_(std::move(momenta)),
        derivative_(std::move(derivative)),
        derivatives_(std::move(derivatives)) {}

  /// p (n outputs) of t and y = (q, q').
  [[nodiscard]] const CompiledFunction& momenta() const { return momenta_; }
  /// z' = (q', p') of t and z.
  [[nodiscard]] const CompiledFunction& derivative() const { return derivative_; }

  /// The parts of dz'/dz bound to parameters.
  [[nodiscard]] Workspace bind_jacobian(std::span<const double> parameters) const {
    return derivatives_.bind(parameters);
  }
  /// dz'/dz, 2n x 2n by rows, of t and z.
  [[nodiscard]] Evaluation jacobian(double t, std::span<const double> z, Workspace& workspace,
                                    std::span<double> jacobian) const;

 private:
  std::size_t n_;
  CompiledFunction momenta_, derivative_;
  CompiledFunction derivatives_;  ///< dq_i'/dz_k (n x 2n), dF_i/dq_k and dF_i/dq_k' (n x n each), by rows
};

/// Of a Lagrangian without inputs; null where it is not quadratic in the velocities.
[[nodiscard]] std::unique_ptr<const CanonicalFunctions> canonical_functions(const Lagrangian& lagrangian);

}  // namespace qdot
