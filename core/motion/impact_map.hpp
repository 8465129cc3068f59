#pragma once
// What an impact does to the state: some components of y = (q, q') become functions of the state before it,
// as the scene says (Goldstein, Classical Mechanics, 3rd ed., 2.7: the impulses).

#include <algorithm>
#include <span>
#include <vector>

#include "core/dynamics/columns.hpp"

namespace qdot {

struct ImpactMap {
  std::vector<Column> components;   ///< functions of the state before
  std::vector<std::size_t> places;  ///< of their values in y

  template <class T>
  void assign(const std::vector<T>& values, std::vector<T>& y) const {
    for (std::size_t i = 0; i < places.size(); ++i) y[places[i]] = values[i];
  }
};

/// That of one of the model's impacts.
[[nodiscard]] ImpactMap impact_map(const Model& model, const ParsedImpact& impact);

}  // namespace qdot
