#pragma once
// Which motion is wanted, and of it what.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/integrate/methods.hpp"
#include "core/integrate/run.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

/// In which impacts of one instant happen.
enum class ImpactOrder { of_scene, reverse };

struct SimulationRequest {
  Reals parameters;  ///< all of them, in order
  Reals y_start;     ///< q, then q'
  double t_start{};
  double t_start_left_out{};  ///< what t_start leaves out of the instant that was typed
  double t_end{};
  std::vector<double> grid;           ///< increasing, in [t_start, t_end]
  std::vector<double> grid_left_out;  ///< what they leave out of the instants that were typed; empty: nothing
  std::function<bool(std::size_t first, std::span<const double> rows)> goes_on{};  ///< as RunRequest::goes_on
  std::vector<Column> columns;      ///< wanted beside the state
  std::vector<std::string> events;  ///< "theta = 0+", or names of the scene's events
  OnInvalid on_invalid{OnInvalid::stop};
  Impacts impacts{Impacts::apply};
  ImpactOrder impact_order{ImpactOrder::of_scene};
  std::optional<std::size_t> end_after_impacts{};  ///< the motion is complete after so many, at least one
  Method method{Method::taylor};
  unsigned taylor_order{};       ///< 0: by the tolerance
  bool is_reference{false};      ///< RunRequest::is_reference
  bool notes_approaches{false};  ///< Simulation::approaches are wanted
  /// The motion that a reference stands for, where its numbers are others by their last digits, and a third
  /// one beside both: two samples of what such digits come to (core/integrate/own_errors.hpp).
  struct Numbers {
    Reals parameters, y_start;
  };
  struct Originals {
    Numbers asked, rounded;
  };
  std::optional<Originals> originals{};
  Tolerances tolerances;  ///< not of a method with a fixed step
  double h{};             ///< the fixed step
  Limits limits;
};

/// A time in which the motion stayed on a kink of its equations: a block that sticks.
struct StayRecord {
  std::string kink;  ///< the expression that stays 0
  double from{}, to{};
};

}  // namespace qdot
