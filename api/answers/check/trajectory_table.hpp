#pragma once
// Submitted trajectories: CSV with a line of names first, or {"t": [...], "l": [...]}.

#include <map>
#include <string>
#include <vector>

#include "api/json/json.hpp"

namespace qdot::api {

struct TrajectoryTable {
  std::vector<double> t{};
  std::map<std::string, std::vector<double>> columns{};  ///< by name, each as long as t
  std::string unreadable{};                              ///< why it could not be read
};

inline constexpr std::size_t most_trajectory_rows = 10'000;

[[nodiscard]] TrajectoryTable trajectory_table(const Json& submitted);

}  // namespace qdot::api
