#pragma once
// Files of the source tree that the build puts inside the program (embed.cmake), so that it needs no others
// beside it when it runs.

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace qdot::api {

struct EmbeddedFile {
  std::string_view name;  ///< "spring_pendulum.json"
  std::string_view text;
};

/// The text of the file of this name. Throws std::logic_error where there is none: an endpoint was added
/// without its JSON file, or under another name.
[[nodiscard]] inline std::string_view text_of(std::span<const EmbeddedFile> files, std::string_view name) {
  const auto found = std::ranges::find(files, name, &EmbeddedFile::name);
  if (found == files.end()) throw std::logic_error("no file \"" + std::string(name) + "\" is built in");
  return found->text;
}

}  // namespace qdot::api
