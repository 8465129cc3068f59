#pragma once
// What is asked for of a motion's error, and which tolerances to try on the way there.

#include <cstdint>
#include <optional>

#include "core/integrate/run.hpp"

namespace qdot {

/// What is asked for beside the motion.
struct AccuracyGoal {
  enum class Kind {
    tolerances,  ///< the request's method and tolerances; the error is measured
    absolute,    ///< error <= value in every column's SI unit
    relative,    ///< error <= value times the column's largest magnitude
    work         ///< the least error for at most `evaluations` evaluations in all
  };
  Kind kind{Kind::tolerances};
  double value{};
  std::uint64_t evaluations{};
  bool verify{true};  ///< false: one run, no estimate; for tolerances only

  [[nodiscard]] bool is_error() const { return kind == Kind::absolute || kind == Kind::relative; }
};

/// Those that are likely to do: errors are ten to a thousand times the tolerance.
[[nodiscard]] Tolerances first_tolerances(const AccuracyGoal& goal);

/// After a run whose error was `excess` times the one wanted.
[[nodiscard]] Tolerances tighter_tolerances(const Tolerances& now, double excess);

/// For a run whose error is so far below the one wanted that a looser one may do: `excess` times that. None
/// where it is not so far below.
[[nodiscard]] std::optional<Tolerances> looser_tolerances(const Tolerances& now, double excess,
                                                          const AccuracyGoal& goal);

/// After runs of which the best took so many evaluations; none where what is left does not suffice.
[[nodiscard]] std::optional<Tolerances> tolerances_for_work(const Tolerances& now, std::uint64_t evaluations,
                                                            std::uint64_t left);

/// Whether the excess that is expected of a run tells the next tolerances well enough. A guess does not where
/// their check takes double-doubles, except from next to them.
[[nodiscard]] bool is_enough_to_expect(const Tolerances& now, double excess);

}  // namespace qdot
