#pragma once
// Simulations with as little said as possible.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/integrate/methods.hpp"
#include "core/motion/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace qdot::test {

/// All that follow a motion to a tolerance.
inline const std::vector<Method> all_methods = [] {
  std::vector<Method> found;
  for (const MethodRecord& record : methods()) {
    if (!record.has_fixed_step()) found.push_back(record.method);
  }
  return found;
}();

/// The method and tolerances that come nearest to the true motion on these systems.
inline constexpr Method best_method = Method::erk;
inline constexpr Tolerances best_tolerances{1e-13, 1e-15};

/// T, V, T + V and h, as far as the scene knows them apart.
inline std::vector<Column> energy_columns(const Model& model) {
  std::vector<Column> columns;
  if (const Lagrangian& l = model.lagrangian; l.kinetic_energy) {
    columns.push_back({"T", "J", *l.kinetic_energy});
    columns.push_back({"V", "J", *l.potential_energy});
    columns.push_back({"energy", "J", *model.energy});
  }
  columns.push_back({"h", "J", model.jacobi});
  return columns;
}

/// count + 1 instants from 0 to t_end.
inline std::vector<double> instants(double t_end, int count) {
  std::vector<double> grid;
  for (int i = 0; i <= count; ++i) grid.push_back(t_end * i / count);
  return grid;
}

/// A mass of 1 kg on a line under a force, an expression in t, x, x_dot and the units F, L and T.
inline std::shared_ptr<const Model> mass_under(const std::string& force) {
  Scene scene;
  scene.name = "mass";
  for (const auto& [name, unit] : {std::pair{"m", "kg"}, {"F", "N"}, {"L", "m"}, {"T", "s"}}) {
    scene.parameters.push_back({name, unit, "1", {}, {}, {}});
  }
  scene.coordinates = {Coordinate{"x", "m", "0", "0", {}, {}, {}, {}}};
  scene.points = {{"P", {"x", "0"}}};
  scene.bodies = {Particle{"body", "m", {"P", {}}}};
  scene.forces = {Force{"all", {force, "0"}, {"P", {}}}};
  return build_model(scene);
}

/// From 0 to the last instant of the grid by the best method; `given` are parameters and initial values by
/// name, the others have their defaults.
inline SimulationRequest request_for(const Model& model, const Values& given, std::vector<double> grid) {
  SimulationRequest request;
  request.parameters = parameter_values(model, given);
  request.y_start = initial_state(model, request.parameters, given);
  request.t_end = grid.back();
  request.grid = std::move(grid);
  request.method = best_method;
  request.tolerances = best_tolerances;
  return request;
}

/// The same as a motion; must reach the end of the grid for a comparison to make sense.
inline Simulation motion_of(const std::string& system, const Values& given, std::vector<double> grid) {
  const auto model = model_of(system);
  return simulate(Dynamics(model), request_for(*model, given, std::move(grid)));
}

inline std::span<const double> row(const Simulation& motion, std::size_t i) {
  const std::size_t width = motion.y.size();
  return std::span(motion.states).subspan(i * width, width);
}

/// The largest difference of two motions on the same grid, each component against its largest value, but one
/// at least.
inline double difference(const Simulation& a, const Simulation& b) {
  double largest = a.rows == b.rows ? 0 : std::nan("");
  for (std::size_t k = 0; k < a.y.size(); ++k) {
    double size = 1;
    for (std::size_t i = 0; i < a.rows; ++i) size = std::max(size, std::abs(row(a, i)[k]));
    for (std::size_t i = 0; i < std::min(a.rows, b.rows); ++i)
      largest = std::max(largest, std::abs(row(a, i)[k] - row(b, i)[k]) / size);
  }
  return largest;
}

}  // namespace qdot::test
