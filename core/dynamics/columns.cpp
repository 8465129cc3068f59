#include "core/dynamics/columns.hpp"

#include <array>
#include <numeric>

namespace qdot {

std::vector<Column> momentum_columns(const Model& model, const std::vector<std::size_t>& coordinates) {
  std::vector<Column> columns;
  for (const std::size_t i : coordinates) {
    columns.push_back(
        {"p_" + model.scene.coordinates[i].name, momentum_unit(model.scene, i), model.momenta[i]});
  }
  return columns;
}

std::vector<Column> momentum_columns(const Model& model) {
  std::vector<std::size_t> all(model.degrees_of_freedom());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return momentum_columns(model, all);
}

std::vector<Column> position_columns(const Model& model) {
  static constexpr std::array<const char*, 3> axes{"_x", "_y", "_z"};
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.scene.points.size(); ++i) {
    const Vector& point = model.parsed.points[i];
    for (std::size_t k = 0; k < point.size(); ++k) {
      columns.push_back({model.scene.points[i].name + axes[k], "m", point[k]});
    }
  }
  return columns;
}

std::vector<Column> acceleration_columns(const Model& model) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.degrees_of_freedom(); ++i) {
    const Coordinate& q = model.scene.coordinates[i];
    columns.push_back({q.name + "_ddot", q.unit == "1" ? "1/s^2" : q.unit + "/s^2",
                       model.parsed.symbols.coordinates.second_rate[i]});
  }
  return columns;
}

std::vector<Column> multiplier_columns(const Model& model) {
  std::vector<Column> columns;
  for (std::size_t j = 0; j < model.scene.constraints.size(); ++j) {
    columns.push_back({multiplier_name(model.scene.constraints[j]),
                       model.parsed.constraints[j].multiplier_unit, model.parsed.symbols.multipliers[j]});
  }
  return columns;
}

std::vector<Column> validity_columns(const Model& model) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.validity.size(); ++i) {
    columns.push_back({model.scene.valid_while[i].name, model.scene.valid_while[i].unit, model.validity[i]});
  }
  return columns;
}

std::vector<Column> report_columns(const Model& model) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < model.reports.size(); ++i) {
    columns.push_back({model.scene.reports[i].name, model.scene.reports[i].unit, model.reports[i]});
  }
  return columns;
}

}  // namespace qdot
