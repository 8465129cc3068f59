#pragma once
// How far a reference may be from the motion that it stands for (core/integrate/own_errors.hpp), from one
// section of a motion to the next.
//
// Both motions meet the event at which a section ends. One meets it at (t, y). The other one is at y - e
// then, and meets it later by delta, where its g is zero as that of the first is:
//
//   g(t + delta, y - e + delta f_-) = g(t, y),
//   e_+ = y_+ - (map(t + delta, y - e + delta f_-) - delta f_+),
//
// with f the slopes y' before and after it. Source: di Bernardo, Budd, Champneys, Kowalczyk,
// Piecewise-smooth Dynamical Systems (2008), 2.3 and 2.5 (saltation matrices).

#include <span>
#include <utility>
#include <vector>

#include "core/motion/section_end.hpp"
#include "core/motion/simulation_request.hpp"

namespace qdot {

/// e_+. Where the motion only grazes the event it is the most that the impact can change, or the size of the
/// motion.
[[nodiscard]] std::vector<double> apart_after(const SectionEnd& end, std::span<const double> e);

/// By how many seconds all computations may take the event too early or too late, because all round g alike.
[[nodiscard]] double rounding_of_instant(const SectionEnd& end);

/// By how many seconds a motion whose components are off by at most `errors` may meet the event earlier or
/// later; no more than a tenth of the motion's own time.
[[nodiscard]] double seconds_apart(const SectionEnd& end, std::span<const double> errors);

/// How much e_+ grows for each second that the event is taken too late: dmap/dt + Dmap f_- - f_+.
[[nodiscard]] std::vector<double> rates_of_instant(const SectionEnd& end);

/// Of a reference, when the request has originals; of others nothing.
class ApartAlong {
 public:
  explicit ApartAlong(const SimulationRequest& request);

  [[nodiscard]] bool is_wanted() const { return is_wanted_; }
  void ask(RunRequest& run, const Originals& originals) const;
  /// Takes the next run's rows, and where it ended. A run that has no such rows changes nothing.
  void add(Run& done);
  /// The same of the motion that is stood for, and of what rounds the instant. `reached` is filled in here,
  /// as below.
  [[nodiscard]] double seconds(SectionEnd end, std::span<const double> unseen) const;
  /// Its `reached` is filled in here. The instant is off by its rounding.
  void pass(SectionEnd end);

  /// From here on all computations may be off by `off`.
  void doubt(std::span<const double> off);

  /// As in Run, of all runs.
  struct Rows {
    std::vector<double> all, by_rounding;
  };
  [[nodiscard]] Rows take_rows() { return std::move(rows_); }
  /// Of each component, where the last run ended; empty where it is not wanted.
  [[nodiscard]] std::vector<double> at_end() const;

 private:
  bool is_wanted_;
  Apart now_;
  std::vector<double> reached_;
  Rows rows_;
};

}  // namespace qdot
