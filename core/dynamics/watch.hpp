#pragma once
// What is watched along a motion: events to report, conditions that must hold, singularities, impacts.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/dynamics/single_crossing.hpp"
#include "core/integrate/run.hpp"
#include "core/numerics/ball.hpp"
#include "core/numerics/interval.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

/// What happens when one of the scene's `valid_while` conditions fails. Leaving a coordinate's domain or
/// meeting a coordinate singularity ends every motion.
enum class OnInvalid { stop, go_on };
/// Whether the scene's impact map is applied at its event.
enum class Impacts { apply, ignore };

struct Watch {
  enum class Kind {
    event,       ///< reported only
    jump,        ///< what stands in a sign() of an event, or in a step such as tanh(), of its name: near zero
                 ///< the event may happen
    impact,      ///< reported; the impact map follows
    validity,    ///< the motion stops when the value falls below 0
    singularity  ///< the motion ends when the value reaches 0
  };
  Kind kind{Kind::event};
  std::string name{};
  std::string reason{}, message{};  ///< of a stop
  Crossing direction{Crossing::either};
  std::function<double(double t, std::span<const double> y)> value{};
  decltype(EventFunction::series) series{};
  decltype(EventFunction::condition) condition{};
  /// Its values over a box of times and states; the whole line where there may be none.
  std::function<Interval(const Interval& t, std::span<const Interval> y)> enclosure{};
  /// The same by its slopes over the box: sum_k dg/dy_k (y_k - m_k) for all y in it and the middle m. Narrow
  /// where one variable stands in several terms that cancel; the whole line where there may be no slopes.
  std::function<Interval(double t, std::span<const Interval> y)> change_over{};
  /// Whether it passes zero no more than once in a box; false where that is not known, null where it never
  /// is.
  decltype(single_crossing_of({}, {})) passes_once{};
  /// It has a sign(), and may jump.
  bool may_jump{false};
  /// Values over a box of what is above zero where a zero counts.
  std::function<Interval(const Interval& t, std::span<const Interval> y)> when_enclosure{};

  /// The value at a state that may be known beyond doubles, as what was typed is.
  std::function<Ball(const Reals& parameters, const Real& t, const Reals& y)> exact{};
  /// Signs along a piece of a motion beyond the rounding of doubles; where `start` is not null, it is the
  /// state where the piece begins.
  std::function<std::vector<SignPiece>(const Reals& parameters, const Reals* start, const SharpLook& look)>
      sharp_signs{};

  /// How far values at a state that was rounded may be from each other, by their enclosure.
  [[nodiscard]] double rounding(double t, std::span<const double> y) const;
  /// How far the value at a state may be rounded itself.
  [[nodiscard]] double own_rounding(double t, std::span<const double> y) const;
  [[nodiscard]] EventFunction event() const;
};

/// Of a function of one output, for any parameters that are nearest to these; made ready when it is first
/// wanted, for all copies.
[[nodiscard]] decltype(Watch::enclosure) enclosure_of(std::shared_ptr<const CompiledFunction> function,
                                                      std::span<const double> parameters);

struct WatchRequest {
  std::span<const double> parameters;
  std::span<const std::string> events{};  ///< "theta = 0+", or names of the scene's events
  OnInvalid on_invalid{OnInvalid::stop};
  Impacts impacts{Impacts::apply};
  const Staying* staying{};  ///< where the motion has kinks: their sides follow the parameters
};

/// All that a request watches, in the order in which simultaneous ones count.
/// Throws what Dynamics::event throws.
[[nodiscard]] std::vector<Watch> watches(const Dynamics& dynamics, const WatchRequest& request);

}  // namespace qdot
