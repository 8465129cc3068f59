#pragma once
// The systems that requests can name: the scenes built into the program, in practice-sheet order, and those
// of a directory that the user gives. A new system is a new file in api/scenes/systems/.
//
// Beside them stand the classics of textbooks, api/scenes/classics/. They are no part of a catalogue: each is
// read when it is asked for, and nothing of it is kept, so that they cost nobody anything else.

#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// A directory of scenes that cannot be used; what() says all mistakes of all files, a line each.
struct BadScenes : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct CatalogueEntry {
  std::string file;  ///< name of the file, for messages
  Json json;         ///< as written
  Scene scene;
};

class Catalogue {
 public:
  /// The scenes of api/scenes/systems/: problems 1 to 10 by their number, then those of no problem, by file
  /// name.
  [[nodiscard]] static Catalogue built_in();

  /// This catalogue and every *.json of `directory` after it, by file name. Throws BadScenes when a
  /// file cannot be read, is no scene, or has a name that is taken.
  [[nodiscard]] Catalogue with_directory(const std::filesystem::path& directory) const;

  /// nullptr for a name that is none.
  [[nodiscard]] const CatalogueEntry* find(std::string_view name) const;

  /// The entry of this name, which lives as long as the catalogue, or a classic, freshly read; else nullptr.
  [[nodiscard]] std::shared_ptr<const CatalogueEntry> find_anywhere(std::string_view name) const;

  [[nodiscard]] std::span<const CatalogueEntry> entries() const { return entries_; }
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  /// The mistakes in this file, a line each; it is added when there are none.
  std::string add(std::string file, std::string_view text);

  std::vector<CatalogueEntry> entries_;
};

/// Names of the classics, in alphabetical order.
[[nodiscard]] std::vector<std::string> classic_names();
/// A classic, freshly read; nullptr for a name that is none.
[[nodiscard]] std::shared_ptr<const CatalogueEntry> read_classic(std::string_view name);

}  // namespace qdot::api
