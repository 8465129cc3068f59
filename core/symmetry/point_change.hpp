#pragma once
// Small changes of a motion, q_i -> q_i + s xi_i(q, t), t -> t + s tau, and what they do to Hamilton's
// principle. A motion obeys d/dt(dL/dq_i') = dL/dq_i + Q_i, so
//
//   d/dt(sum p_i xi_i - tau h - F) = R,
//   R = sum ((dL/dq_i + Q_i) xi_i + p_i dxi_i/dt) + tau (dL/dt - sum Q_i q_i') - dF/dt
//
// for every F(q, t), with p_i = dL/dq_i' and h = sum p_i q_i' - L. Where R vanishes identically the change is
// a symmetry, and what stands in brackets is constant (E. Noether, Invariante Variationsprobleme, 1918; with
// F: Bessel-Hagen, 1921; Goldstein, Classical Mechanics, 3rd ed., 13.7). Q_i holds forces outside L, too: in
// R they must do no work along the change, or work that is a total derivative.
// The multiplier of a constraint w = 0 (constraints.hpp) enters with A xi + tau b, since A q' = -b.

#include <vector>

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

/// How an affine change depends on where and when it is.
/// along, turn and own_turn: constrained_changes.hpp.
enum class ChangeKind { gauge, shift, boost, along, turn, own_turn, linear, time };

struct PointChange {
  std::vector<Expression> shift;  ///< xi_i
  Expression time;                ///< tau, a constant
  Expression gauge;               ///< F
};

/// One with a coefficient of its own: xi_i = 1, t or q_j; tau = 1; F = a monomial of degree one or two; or
/// what constraints single out: a turn of body i about its axis j, or along them with coordinate i.
struct ElementaryChange {
  ChangeKind kind;
  std::size_t i{}, j{};
  PointChange change;
};

/// All of them: first gauges, then shifts of all coordinates but `ignorable`, boosts, linear ones, and time
/// unless `time_is_known`.
[[nodiscard]] std::vector<ElementaryChange> elementary_changes(const Lagrangian& lagrangian,
                                                               const std::vector<bool>& ignorable,
                                                               bool time_is_known);

/// Sum of coefficient times change.
[[nodiscard]] PointChange combination(Graph& graph, std::span<const Expression> coefficients,
                                      std::span<const ElementaryChange> changes);

/// R, linear in the change; the derivatives of L are taken once.
class Variation {
 public:
  /// `on_constraints`: rates by others, as the constraints give them.
  explicit Variation(const Lagrangian& lagrangian, std::vector<Replacement> on_constraints = {});
  [[nodiscard]] Expression operator()(const PointChange& change) const;

 private:
  Graph& graph_;
  std::vector<Replacement> rates_;  ///< q -> q', t -> 1
  std::vector<Replacement> on_constraints_;
  std::vector<Expression> slopes_;  ///< dL/dq_i + Q_i
  std::vector<Expression> momenta_;
  Expression power_;  ///< what tau multiplies
};

/// sum p_i xi_i - tau h - F in short form; where the time is changed, its opposite, which begins with h.
[[nodiscard]] Expression noether_quantity(const Lagrangian& lagrangian, const PointChange& change);

}  // namespace qdot
