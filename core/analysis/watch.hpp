#pragma once
// What is watched along a motion: events to report, conditions that must hold, singularities, impacts.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/dynamics.hpp"
#include "core/integrate/run.hpp"

namespace qdot {

struct SimulationRequest;

struct Watch {
  enum class Kind {
    event,       ///< reported only
    impact,      ///< reported; the impact map follows
    validity,    ///< the motion stops when the value falls below 0
    singularity  ///< the motion ends when the value reaches 0
  };
  Kind kind{Kind::event};
  std::string name;
  std::string reason, message;  ///< of a stop
  Crossing direction{Crossing::either};
  std::function<double(double t, std::span<const double> y)> value;
  std::function<bool(double t, std::span<const double> y)> condition;  ///< optional: where a zero counts

  [[nodiscard]] EventFunction event() const;
};

/// All that a request watches, in the order in which simultaneous ones count.
[[nodiscard]] std::vector<Watch> watches(const Dynamics& dynamics, const SimulationRequest& request);

}  // namespace qdot
