#pragma once
// Which way equilibria of one unknown x appear, vanish or meet at (x0, p0), N = N_x = 0 there, proven from
// the signs of enclosed derivatives of the force N(x, p):
//   saddle_node     N_p != 0 and N_xx != 0
//   transcritical   two curves of equilibria cross, N_xx != 0
//   pitchfork       N is odd about c(p) for every p (known from its formula), c(p0) = x0, N_xp != 0 and
//                   N_xxx != 0; or N = (x - c(p)) M, M = M_x = 0 (known from its formula, too), and the same
// Where none of these is proven the kind is unresolved.
// Source: Kuznetsov, Elements of Applied Bifurcation Theory (2004), 3.2 and 7.4; Golubitsky, Schaeffer,
// Singularities and Groups in Bifurcation Theory I (1985), II.9.

#include <vector>

#include "core/steady/critical_value.hpp"
#include "core/steady/critical_zeros.hpp"

namespace qdot {

struct NormalForm {
  BifurcationKind kind{};
  Interval x, p;
  bool proven{};  ///< to be one point
  std::size_t axis{};
};

/// What happens on the axes about which the forces are odd, where p moves through `range`.
class SymmetryAxes {
 public:
  /// Of one unknown. All must outlive it.
  SymmetryAxes(const SteadyProblem& problem, const BifurcationSystems& systems, const Interval& range);

  [[nodiscard]] const std::vector<NormalForm>& found() const { return found_; }
  [[nodiscard]] bool is_complete() const { return complete_; }
  /// Every zero of N = N_x = 0 with (x, p) in the box is one of found().
  [[nodiscard]] bool explain(std::span<const Interval> box);

 private:
  void search(std::size_t axis, const Interval& range);
  [[nodiscard]] Interval centre(std::size_t axis, const Interval& p) const;
  Box derivatives(const CompiledFunction& function, const Interval& x, const Interval& p);
  [[nodiscard]] bool is_alone(const Interval& x, const Interval& p);

  const SteadyProblem& problem_;
  const BifurcationSystems& systems_;
  std::vector<NormalForm> found_;
  bool complete_{true};
};

/// A curve turns back in the box, and no other crosses it there: a fold of one factor of N is one of N only
/// where the others do not vanish.
[[nodiscard]] bool is_saddle_node(const SteadyProblem& problem, const BifurcationSystems& systems,
                                  const CriticalZero& fold);

/// Two curves cross in the box, and neither turns back there.
[[nodiscard]] bool is_transcritical(const SteadyProblem& problem, const BifurcationSystems& systems,
                                    const CriticalZero& crossing);

/// Where a curve is known to fold at the very place where it meets another: its fold is a simple one, and
/// both cross there.
[[nodiscard]] bool is_pitchfork(const SteadyProblem& problem, const BifurcationSystems& systems,
                                const CriticalZero& meeting);

}  // namespace qdot
