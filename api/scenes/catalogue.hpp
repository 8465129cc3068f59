#pragma once
// The systems that requests can name: the scenes built into the program, in practice-sheet order, and those
// of a directory that the user gives. A new system is a new file in api/scenes/systems/.
//
// Beside them stand the classics of textbooks, api/scenes/classics/. They are not among a catalogue's
// entries: each is read when it is first asked for, so that it costs nobody else anything.

#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.hpp"
#include "core/base/made_once.hpp"
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

/// The classics that were asked for; shared by threads.
class Classics {
 public:
  /// It lives as long as this; nullptr for a name that is none.
  [[nodiscard]] std::shared_ptr<const CatalogueEntry> find(std::string_view name);
  /// Whether the scene is that of a classic, and no other one of the same name.
  [[nodiscard]] bool owns(const Scene& scene);

 private:
  MadeOnce<std::string, std::shared_ptr<const CatalogueEntry>> entries_;
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

  /// The entry of this name, or a classic, both living as long as the catalogue; else nullptr.
  [[nodiscard]] std::shared_ptr<const CatalogueEntry> find_anywhere(std::string_view name) const;
  [[nodiscard]] const std::shared_ptr<Classics>& classics() const { return classics_; }

  [[nodiscard]] std::span<const CatalogueEntry> entries() const { return entries_; }
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  /// The mistakes in this file, a line each; it is added when there are none.
  std::string add(std::string file, std::string_view text);

  std::vector<CatalogueEntry> entries_;
  std::shared_ptr<Classics> classics_ = std::make_shared<Classics>();
};

/// Names of the classics, in alphabetical order.
[[nodiscard]] std::vector<std::string> classic_names();
/// A classic, freshly read; nullptr for a name that is none.
[[nodiscard]] std::shared_ptr<const CatalogueEntry> read_classic(std::string_view name);

}  // namespace qdot::api
