#pragma once
// What a question may cost, and whether anyone still waits for its answer. The thread that computes knows
// both, so that algebra and searches far below the question need not pass them on. An integration has its own
// bounds on steps and evaluations (core/integrate/run.hpp); of this it uses only check_interruption().

#include <cstdint>
#include <functional>

namespace qdot {

/// Thrown when nobody waits for the answer any more.
/// It is not an Error, so that nothing else is tried after it.
struct Interrupted {};

/// While it lives, what its thread computes may cost `units`. A unit is one step of algebra, such as a
/// product of two terms or an operation on intervals, and takes well under a microsecond. Scopes nest; work
/// counts against the innermost. `interrupted` says whether nobody waits any more.
class WorkScope {
 public:
  explicit WorkScope(std::uint64_t units, std::function<bool()> interrupted = {});
  ~WorkScope();
  WorkScope(const WorkScope&) = delete;
  WorkScope& operator=(const WorkScope&) = delete;

 private:
  friend void spend_work(std::uint64_t units);
  friend std::uint64_t work_left();
  friend void check_interruption();

  std::uint64_t left_;
  std::uint64_t unpolled_{};  ///< units since `interrupted_` was last asked
  std::function<bool()> interrupted_;
  WorkScope* outer_;
};

/// Counts the units against the innermost scope of this thread; without a scope nothing is bounded. Throws
/// Error(too_large) past the bound. Every few thousand units it checks for an interruption, too.
void spend_work(std::uint64_t units = 1);

/// What the innermost scope of this thread still allows: a search ends before all of it is spent, so that
/// what was found can be told. Without a scope, the largest number.
[[nodiscard]] std::uint64_t work_left();

/// Throws Interrupted if the scope's `interrupted` says that nobody waits any more.
void check_interruption();

/// The same in a loop of short steps: looks every few thousand of them.
void check_interruption(std::uint64_t step);

}  // namespace qdot
