#pragma once
// Headings of a submitted table's columns: "t", "time [s]", "θ (deg)", "l/cm", "theta'".

#include <string>
#include <string_view>

#include "core/mechanics/dimension.hpp"

namespace qdot::api {

struct ColumnHeading {
  std::string name{};  ///< in plain notation; the time is t
  double factor{1};    ///< SI in one of the unit that it names
  bool has_unit{};
  Dimension dimension{};  ///< of that unit
};

[[nodiscard]] ColumnHeading column_heading(std::string_view cell);

}  // namespace qdot::api
