#pragma once
// Models of the scenes that tests speak of, each read and derived once in a process.

#include <memory>
#include <string>
#include <vector>

#include "core/mechanics/model.hpp"

namespace qdot::test {

/// The practice problems, in their order: the scenes in api/scenes/systems/.
[[nodiscard]] const std::vector<std::string>& practice_systems();
/// Systems whose motion textbooks give: the scenes in tests/reference/scenes/.
[[nodiscard]] const std::vector<std::string>& textbook_systems();

/// The scene of either kind, freshly read, so that a test may change it.
[[nodiscard]] Scene scene_of(const std::string& name);
[[nodiscard]] std::shared_ptr<const Model> model_of(const std::string& name);
/// Of a scene that a test writes out as JSON.
[[nodiscard]] std::shared_ptr<const Model> model_written(const std::string& json);

}  // namespace qdot::test
