#pragma once
// The files of this directory, and api/problems.json, inside the program. embed.cmake writes the definitions.

#include <span>
#include <string_view>

namespace qdot::api::embedded {

struct File {
  std::string_view name;  ///< "spring_pendulum.json"
  std::string_view text;
};

/// Every scene, in the order of the files' names.
[[nodiscard]] std::span<const File> scenes();

/// schema.json.
[[nodiscard]] std::string_view schema();

/// problems.json.
[[nodiscard]] std::string_view problems();

}  // namespace qdot::api::embedded
