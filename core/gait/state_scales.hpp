#pragma once
// States without dimension: lengths, times and masses in the scene's scales (Scene::scales), or in SI units
// where it has none that are finite.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

class StateScales {
 public:
  StateScales() = default;
  StateScales(const Model& model, std::span<const double> parameters);

  /// Of each component of y = (q, q') and of the time, in SI units.
  [[nodiscard]] const Eigen::VectorXd& units() const { return units_; }
  [[nodiscard]] double time_unit() const { return time_unit_; }

  [[nodiscard]] std::vector<double> in_si(const Eigen::VectorXd& state) const;
  [[nodiscard]] Eigen::VectorXd in_units(const Eigen::VectorXd& si) const { return si.cwiseQuotient(units_); }
  /// The event of what is watched in SI units. Keeps a reference to these scales.
  [[nodiscard]] EventFunction event(const Watch& watch) const;

 private:
  Eigen::VectorXd units_;
  double time_unit_{1};
};

}  // namespace qdot
