#include "api/scenes/catalogue.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "api/contract/json_reader.hpp"
#include "api/json/documents.hpp"
#include "api/json/limits.hpp"
#include "api/scenes/embedded.hpp"
#include "api/scenes/scene_reader.hpp"

namespace qdot::api {
namespace {

std::string mistake(const std::string& file, std::string_view place, std::string_view message) {
  return file + ": " + std::string{place} + (place.empty() ? "" : ": ") + std::string{message} + "\n";
}

std::string mistake(const std::string& file, const FieldError& error) {
  std::string help;
  if (!error.did_you_mean.empty()) {
    help = " Did you mean '" + error.did_you_mean + "'?";
  } else if (!error.allowed.empty()) {
    help = " Write " + enumerated(error.allowed) + ".";
  }
  return mistake(file, std::string_view{error.pointer}.substr(1), error.detail + help);
}

/// The number on the practice sheet; scenes without one come last.
int problem_number(const Scene& scene) {
  int number = std::numeric_limits<int>::max();
  std::from_chars(scene.problem.data(), scene.problem.data() + scene.problem.size(), number);
  return number;
}

std::vector<std::filesystem::path> json_files(const std::filesystem::path& directory) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  std::filesystem::directory_iterator entry{directory, error};
  for (; !error && entry != std::filesystem::directory_iterator{}; entry.increment(error)) {
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  }
  if (error) throw BadScenes("Cannot read the scenes directory " + directory.string() + ".");
  std::sort(files.begin(), files.end());
  return files;
}

/// At most one byte more than a scene may have, so that an overlong file shows.
std::optional<std::string> contents(const std::filesystem::path& path) {
  std::ifstream stream{path, std::ios::binary};
  std::string text(limits::body_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || (stream.fail() && !stream.eof())) return std::nullopt;
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace

Catalogue Catalogue::built_in() {
  Catalogue catalogue;
  for (const auto& [name, text] : system_files()) {
    [[maybe_unused]] const std::string mistakes = catalogue.add(std::string{name}, text);
    assert(mistakes.empty());
  }
  std::stable_sort(catalogue.entries_.begin(), catalogue.entries_.end(), [](const auto& a, const auto& b) {
    return problem_number(a.scene) < problem_number(b.scene);
  });
  return catalogue;
}

Catalogue Catalogue::with_directory(const std::filesystem::path& directory) const {
  Catalogue catalogue{*this};
  std::string mistakes;
  for (const std::filesystem::path& path : json_files(directory)) {
    const std::string file = path.filename().string();
    const auto text = contents(path);
    mistakes += text ? catalogue.add(file, *text) : mistake(file, "", "The file cannot be read.");
  }
  if (!mistakes.empty()) throw BadScenes(mistakes);
  return catalogue;
}

std::string Catalogue::add(std::string file, std::string_view text) {
  auto parsed = read_json(text);
  if (const auto* problem = std::get_if<Problem>(&parsed)) return mistake(file, "", problem->detail);
  auto& document = std::get<JsonDocument>(parsed);
  auto [scene, errors] = read_scene(document.value, Place::of_document(&document.numbers));

  std::string mistakes;
  for (const FieldError& error : document.duplicates) mistakes += mistake(file, error);
  for (const FieldError& error : errors) mistakes += mistake(file, error);
  if (const CatalogueEntry* taken = find(scene.name)) {
    mistakes += mistake(file, "/name", "The name '" + scene.name + "' is taken by " + taken->file + ".");
  }
  if (mistakes.empty()) entries_.push_back({std::move(file), std::move(document.value), std::move(scene)});
  return mistakes;
}

const CatalogueEntry* Catalogue::find(std::string_view name) const {
  const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                  [name](const CatalogueEntry& known) { return known.scene.name == name; });
  return entry == entries_.end() ? nullptr : &*entry;
}

std::shared_ptr<const CatalogueEntry> Catalogue::find_anywhere(std::string_view name) const {
  if (const CatalogueEntry* entry = find(name)) return {std::shared_ptr<void>(), entry};
  return classics_->find(name);
}

std::shared_ptr<const CatalogueEntry> Classics::find(std::string_view name) {
  const bool is_known = std::ranges::find(classic_files(), std::string{name} + ".json",
                                          &EmbeddedFile::name) != classic_files().end();
  return is_known ? entries_.get(std::string{name}, [&] { return read_classic(name); }) : nullptr;
}

bool Classics::owns(const Scene& scene) {
  const std::shared_ptr<const CatalogueEntry> entry = find(scene.name);
  return entry && &entry->scene == &scene;
}

std::vector<std::string> classic_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : classic_files())
    names.emplace_back(file.name.substr(0, file.name.rfind('.')));
  return names;
}

std::shared_ptr<const CatalogueEntry> read_classic(std::string_view name) {
  const auto files = classic_files();
  const auto file = std::ranges::find(files, std::string{name} + ".json", &EmbeddedFile::name);
  if (file == files.end()) return nullptr;
  Json json = parse_json(file->text);
  SceneReading reading = read_scene(json);
  assert(reading.errors.empty() && reading.scene.name == name);
  return std::make_shared<const CatalogueEntry>(
      CatalogueEntry{std::string{file->name}, std::move(json), std::move(reading.scene)});
}

std::vector<std::string> Catalogue::names() const {
  std::vector<std::string> names;
  for (const CatalogueEntry& entry : entries_) names.push_back(entry.scene.name);
  return names;
}

}  // namespace qdot::api
