#pragma once
// The one slip that explains a wrong formula or equation exactly, where there is one.
//
// The right formula is multiplied out into terms t. A slip turns one of them, those of one symbol, or all,
// into something else: E -> E + d. For a formula S the slip is found where S = E + d. For an equation r = 0,
// which may have been multiplied by anything, it is found where r is a multiple of rho + d, rho being the
// right residual: r d(rho + d)/dq'' = (rho + d) dr/dq''. Where they share no acceleration, because the slip
// has taken it away, r may have been multiplied by parameters and numbers: the same then holds for every x
// that changes in time in the place of q''. Number factors are not guessed: E -> E + mu t gives mu at one
// state, and others confirm it.

#include <optional>
#include <span>
#include <vector>

#include "core/grading/sampled_states.hpp"
#include "core/grading/slip_kind.hpp"

namespace qdot {

struct FoundSlip {
  Slip slip{};
  std::optional<Expression> term;      ///< as it stands in the submission, up to a factor; none: all of it
  std::optional<Number> factor;        ///< of a wrong factor: what stands there over what should
  std::optional<Expression> shared{};  ///< the symbol that several wrong terms have in common
};

struct SlipQuestion {
  Expression submitted, expected;           ///< formulas, or residuals of equations
  std::vector<Expression> accelerations{};  ///< of equations; none: they are formulas
  std::vector<Expression> changing{};       ///< what else changes in time
  std::span<const SymbolDomain> symbols;
  std::optional<Expression> gravity{};  ///< the symbol of its strength
  std::vector<Expression> inertia{};    ///< d of moments of inertia, to be added or taken away
  std::uint64_t seed{};
};

[[nodiscard]] std::optional<FoundSlip> find_slip(const SlipQuestion& question);

}  // namespace qdot
