#pragma once

#include <span>
#include <string_view>

namespace qdot::api {

/// A file of the source tree inside the program (embed.cmake).
struct EmbeddedFile {
  std::string_view name;  ///< "spring_pendulum.json"
  std::string_view text;
};

/// The text of the file of this name, which must be there.
[[nodiscard]] inline std::string_view text_of(std::span<const EmbeddedFile> files, std::string_view name) {
  std::size_t i = 0;
  while (files[i].name != name) ++i;
  return files[i].text;
}

}  // namespace qdot::api
