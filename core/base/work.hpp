#pragma once
// What a question may cost, and whether anyone still waits for its answer. The thread that computes knows
// both, so that algebra and searches far below the question need not hand them on. Integrations have bounds
// of their own (core/integrate/integrate.hpp) and only look whether they are awaited.

#include <cstdint>
#include <functional>

namespace qdot {

/// Nobody waits for the answer any more. Not an Error: after this nothing else is tried.
struct Interrupted {};

/// While it lives, what its thread computes may cost `units`: steps of algebra, such as a product of two
/// terms or an operation on intervals, each well under a microsecond. Scopes nest; the innermost counts.
class WorkScope {
 public:
  explicit WorkScope(std::uint64_t units, std::function<bool()> interrupted = {});
  ~WorkScope();
  WorkScope(const WorkScope&) = delete;
  WorkScope& operator=(const WorkScope&) = delete;

 private:
  friend void spend_work(std::uint64_t units);
  friend void check_interruption();

  std::uint64_t left_;
  std::uint64_t unpolled_{};  ///< units since `interrupted_` was last asked
  std::function<bool()> interrupted_;
  WorkScope* outer_;
};

/// Counts; without a scope nothing is bounded. Throws Error(too_large) past the bound and, every few thousand
/// units, Interrupted.
void spend_work(std::uint64_t units = 1);

/// Throws Interrupted when the scope is told that nobody waits.
void check_interruption();

}  // namespace qdot
