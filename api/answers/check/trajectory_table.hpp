#pragma once
// Submitted trajectories: CSV with a line of names first, which may have units, {"t": [...], "l": [...]}, or
// [{"t": 0, "l": 0.5}, ...].

#include <map>
#include <string>
#include <vector>

#include "api/answers/check/column_heading.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

struct TrajectoryTable {
  std::vector<double> t{};                               ///< in s
  std::map<std::string, std::vector<double>> columns{};  ///< by name, each as long as t
  std::map<std::string, ColumnHeading> units{};          ///< of those columns
  std::string unreadable{};                              ///< why it could not be read
};

inline constexpr std::size_t most_trajectory_rows = 10'000;

[[nodiscard]] TrajectoryTable trajectory_table(const Json& submitted);

}  // namespace qdot::api
