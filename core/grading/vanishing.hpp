#pragma once
// Whether an expression vanishes identically: what the comparison of formulas and equations comes to.
//
// First by its form; then by enclosures at seeded states. An enclosure that excludes zero is a proof that it
// does not vanish, and its state a counterexample. Where all states agree, the algebra of zeroness.hpp
// says whether that is an identity. Places where it has no value, or where not all of it can be seen, are
// left out; with too few of others there is no answer.
//
// Numbers that were rounded may be allowed: a difference then counts as none where it is at most `tolerance`
// times the size of what is compared, at more states, of which some are far apart, so that a missing term is
// seen.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/grading/ball_values.hpp"
#include "core/grading/sampled_states.hpp"

namespace qdot {

/// Values of symbols at a state, in the order of the domains.
using State = std::vector<double>;

struct VanishingQuestion {
  Expression value;
  std::span<const SymbolDomain> symbols;
  std::uint64_t seed{};
  /// Sets what follows from a state, such as the accelerations, and may move it, to the surface of
  /// constraints; false where it does not exist there.
  std::function<bool(State& state, BallValues& values)> complete{};
  /// The value in the symbols alone, for the algebra, when it is not `value` itself; none: too long.
  std::function<std::optional<Expression>()> in_symbols{};
  double tolerance{0};
  std::function<double(const State& state)> size{};  ///< where there is a tolerance
};

enum class Decision {
  identity,
  values,
  rounded,  ///< it does not vanish, and is within the tolerance
  counterexample,
  unknown
};

struct VanishingAnswer {
  Decision decision{Decision::unknown};
  State counterexample{};
};

[[nodiscard]] VanishingAnswer vanishing(const VanishingQuestion& question);

}  // namespace qdot
