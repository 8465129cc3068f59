#pragma once
// A method, seen from the loop in integrate.cpp: it steps as it likes and can say where the solution was
// inside its last step. This is the one place with runtime polymorphism:
// methods of very different make stand behind it.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/integrate/run.hpp"

namespace qdot {

/// Starts at (t_start, y_start). Steps depend on the right-hand side, t_end and the tolerances (or h)
/// only, never on interpolate(), so that looking at a solution does not change it.
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Takes one step of the method's own choosing, never evaluating f beyond t_end. Empty: t() and y() are the
  /// new end. Otherwise why no step was possible; t() and y() stay where they were.
  [[nodiscard]] virtual std::optional<Ending> step() = 0;

  /// Beginning and end of the last step; both t_start before the first one.
  [[nodiscard]] virtual double t_previous() const = 0;
  [[nodiscard]] virtual double t() const = 0;
  [[nodiscard]] virtual std::span<const double> y() const = 0;

  /// Dense output: y(t) for t_previous() <= t <= t(), exactly the end states at the two ends. May cost
  /// evaluations and therefore fail with their Ending.
  [[nodiscard]] virtual std::optional<Ending> interpolate(double t, std::span<double> y_out) = 0;

  /// The same at several increasing times, row by row, to the bit. What was written before a failure stays.
  [[nodiscard]] virtual std::optional<Ending> sample(std::span<const double> times, std::span<double> rows) {
    const std::size_t width = times.empty() ? 0 : rows.size() / times.size();
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (const auto failed = interpolate(times[i], rows.subspan(i * width, width))) return failed;
    }
    return std::nullopt;
  }

  /// y(t) inside the last step roughly, at little cost: enough to see that nothing changes sign there.
  /// Methods whose dense output is cheap give that.
  [[nodiscard]] virtual std::optional<Ending> sketch(double t, std::span<double> y_out) {
    return interpolate(t, y_out);
  }

  /// The dense output of the last step where it is polynomials in t - t_previous(); empty where it is not.
  /// Valid until the next step.
  [[nodiscard]] virtual std::optional<MotionPiece> polynomials() const { return std::nullopt; }

  /// Why f last had no value at a place that was tried, since time last advanced; empty if it always had one.
  [[nodiscard]] virtual std::optional<Ending> trouble() const = 0;

  /// As Run::bounded, for the steps up to now.
  [[nodiscard]] virtual bool bounded() const { return false; }
  /// The run ends at t, within the last step: unseen() is of no more than that. The last that is asked but
  /// for interpolation.
  virtual void end_at(double t) { (void)t; }
  /// As Run::unseen, at t(); empty where there is nothing.
  [[nodiscard]] virtual std::span<const double> unseen() const { return {}; }

  /// As a row of Run::accelerations, for the last step; empty where there are none.
  [[nodiscard]] virtual std::span<const double> accelerations() { return {}; }

  [[nodiscard]] virtual std::uint64_t steps() const = 0;
  [[nodiscard]] virtual std::uint64_t evaluations() const = 0;
};

}  // namespace qdot
