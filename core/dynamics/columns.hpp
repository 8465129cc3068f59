#pragma once
// The quantities of a model that can be asked for along a motion.

#include <string>
#include <vector>

#include "core/mechanics/model.hpp"

namespace qdot {

/// A quantity along a motion: one column.
struct Column {
  std::string name;
  std::string unit;
  Expression value;  ///< in t, q, q', q'', the parameters and inputs; of the model's graph
};

[[nodiscard]] std::vector<Column> momentum_columns(const Model& model);  ///< p_i = dL/dq_i'
/// The momenta of some coordinates, such as the ignored ones of a reduction.
[[nodiscard]] std::vector<Column> momentum_columns(const Model& model,
                                                   const std::vector<std::size_t>& coordinates);
[[nodiscard]] std::vector<Column> position_columns(const Model& model);      ///< of the scene's named points
[[nodiscard]] std::vector<Column> acceleration_columns(const Model& model);  ///< q''
[[nodiscard]] std::vector<Column> multiplier_columns(const Model& model);    ///< of the constraints
[[nodiscard]] std::vector<Column> validity_columns(const Model& model);      ///< the scene's `valid_while`
[[nodiscard]] std::vector<Column> report_columns(const Model& model);  ///< what the scene reports beside

}  // namespace qdot
