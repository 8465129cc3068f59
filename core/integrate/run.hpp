#pragma once
// Integration of y' = f(t, y): right-hand side, sampling grid and events in, run out.
// Stepping (stepper.hpp), events (events.hpp) and sampling on the grid are three pieces that meet in run.cpp.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace qdot {

/// What one evaluation of a compiled function came to.
enum class Evaluation { ok, nonfinite, singular_mass };

/// y' = f(t, y). All functions are noexcept in effect: they report by value, never by throwing.
struct RightHandSide {
  std::size_t dimension{};
  std::function<Evaluation(double t, std::span<const double> y, std::span<double> derivative)> derivative;
  /// df/dy, row-major dimension x dimension; needed by Method::bdf only.
  std::function<Evaluation(double t, std::span<const double> y, std::span<double> jacobian)> jacobian;
};

enum class Direction { rising, falling, either };

/// A zero of g(t, y). `condition` (optional) says whether a zero found at (t, y) counts.
struct EventFunction {
  std::function<double(double t, std::span<const double> y)> value;
  Direction direction{Direction::either};
  bool terminal{false};
  std::function<bool(double t, std::span<const double> y)> condition;
};

enum class Method { adams, bdf, erk };

struct Tolerances {
  double rtol{1e-9};
  double atol{1e-12};
};

/// Deterministic bounds on the work; `interrupted` is polled every 64 evaluations (deadline, client gone).
struct Limits {
  std::uint64_t max_steps{1'000'000};
  std::uint64_t max_evaluations{5'000'000};
  double max_magnitude{1e150};
  std::function<bool()> interrupted;
};

struct RunRequest {
  double t_start{};
  std::vector<double> y_start;
  double t_end{};
  /// Instants at which the state is wanted: increasing, in [t_start, t_end]; t_start itself gives y_start.
  std::span<const double> grid;
  std::vector<EventFunction> events;
  Method method{Method::adams};
  Tolerances tolerances;
  Limits limits;
};

enum class Ending {
  reached_end,
  event,          ///< a terminal event
  step_limit,     ///< max_steps or max_evaluations spent, or 1000 steps without progress
  nonfinite,      ///< f became infinite or undefined
  singular_mass,  ///< the mass matrix lost its inverse
  tolerance,      ///< the tolerances ask for more than double precision holds
  blow_up,        ///< |y| beyond max_magnitude
  interrupted
};

struct EventOccurrence {
  std::size_t event{};  ///< index into RunRequest::events
  double t{};
  std::vector<double> y;
};

struct Run {
  std::size_t rows{};          ///< instants of the grid that were reached
  std::vector<double> states;  ///< rows x dimension, row-major
  std::vector<EventOccurrence> events;  ///< in order of time
  Ending ending{Ending::reached_end};
  double t{};              ///< where the run ended: t_end, the event, or the last good step
  std::vector<double> y;   ///< the state there
  std::uint64_t steps{};
  std::uint64_t evaluations{};
};

/// Integrates from t_start to t_end > t_start. The result does not depend on the grid or on non-terminal events.
[[nodiscard]] Run integrate(const RightHandSide& system, const RunRequest& request);

}  // namespace qdot
