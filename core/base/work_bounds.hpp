#pragma once
// Whether a question may cost what it costs. A service bounds the work of each question, so that none takes
// the others'; someone who asks on a machine of their own has only their patience.

namespace qdot {

enum class WorkBounds { of_a_service, none };

/// Holds for what its thread computes while it lives. Scopes nest; without one, the bounds are a service's.
class WorkBoundsScope {
 public:
  explicit WorkBoundsScope(WorkBounds bounds);
  ~WorkBoundsScope();
  WorkBoundsScope(const WorkBoundsScope&) = delete;
  WorkBoundsScope& operator=(const WorkBoundsScope&) = delete;

 private:
  WorkBounds outer_;
};

/// Those of this thread.
[[nodiscard]] WorkBounds work_bounds();

}  // namespace qdot
