#pragma once
// The files of this directory, api/problems.json and api/openapi/, inside the program. embed.cmake
// writes the definitions.

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

/// openapi/addresses.json: what is said of each address; openapi/answers.json: JSON Schemas of answers.
[[nodiscard]] std::string_view openapi_addresses();
[[nodiscard]] std::string_view openapi_answers();

}  // namespace qdot::api::embedded
