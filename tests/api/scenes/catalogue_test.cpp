#include "api/scenes/catalogue.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace qdot::api {
namespace {

namespace fs = std::filesystem;

/// A directory that goes when the test ends.
class Directory {
 public:
  Directory() : path_{fs::temp_directory_path() / ("qdot_catalogue_" + std::to_string(::getpid()))} {
    fs::remove_all(path_);
    fs::create_directory(path_);
  }
  ~Directory() { fs::remove_all(path_); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  void write(const std::string& file, const std::string& text) const { std::ofstream{path_ / file} << text; }

 private:
  fs::path path_;
};

std::string cart_named(const std::string& name) {
  return R"({"name": ")" + name + R"(", "coordinates": [{"name": "x", "unit": "m"}],
             "bodies": [{"kind": "particle", "mass": 1, "position": ["x", 0]}]})";
}

std::string mistakes_in(const Directory& directory) {
  try {
    (void)Catalogue::built_in().with_directory(directory.path());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Catalogue, HasTheProblemsInTheirOrder) {
  EXPECT_EQ(Catalogue::built_in().names(),
            (std::vector<std::string>{"spring_pendulum", "forced_spring_pendulum", "rolling_disk_platform",
                                      "cart_pendulum", "rod_pendulum", "rod_spring_pendulum",
                                      "whirling_pendulum", "orbiting_pendulum", "free_spin_pendulum",
                                      "compass_walker", "rotating_l_bar"}));
}

TEST(Catalogue, EverySceneIsForStudents) {
  const Catalogue catalogue = Catalogue::built_in();
  for (const CatalogueEntry& entry : catalogue.entries()) {
    EXPECT_EQ(entry.file, entry.scene.name + ".json");
    EXPECT_FALSE(entry.scene.title.empty()) << entry.file;
    EXPECT_FALSE(entry.scene.description.empty()) << entry.file;
    EXPECT_FALSE(entry.scene.model_version.empty()) << entry.file;
    EXPECT_FALSE(entry.scene.lines.empty()) << entry.file;
    EXPECT_TRUE(entry.scene.scales) << entry.file;
    for (const Parameter& parameter : entry.scene.parameters)
      EXPECT_FALSE(parameter.meaning.empty()) << entry.file;
    for (const Coordinate& coordinate : entry.scene.coordinates) EXPECT_FALSE(coordinate.meaning.empty());
  }
}

TEST(Catalogue, FindsByName) {
  const Catalogue catalogue = Catalogue::built_in();
  ASSERT_NE(catalogue.find("compass_walker"), nullptr);
  EXPECT_EQ(catalogue.find("compass_walker")->json["coordinates"][0]["name"], "theta");
  EXPECT_EQ(catalogue.find("compass_walkr"), nullptr);
  EXPECT_EQ(catalogue.find(""), nullptr);
}

TEST(Catalogue, TakesMoreScenesFromADirectory) {
  const Directory directory;
  directory.write("b.json", cart_named("second"));
  directory.write("a.json", cart_named("first"));
  directory.write("notes.txt", "no scene");
  const auto names = Catalogue::built_in().with_directory(directory.path()).names();
  ASSERT_EQ(names.size(), 13U);
  EXPECT_EQ(names[11], "first");
  EXPECT_EQ(names[12], "second");
}

TEST(Catalogue, ReportsAllMistakesOfAllFiles) {
  const Directory directory;
  directory.write("a.json", R"({"name": "a", "coordinates": [], "bodies": 1})");
  directory.write("b.json", "{");
  directory.write("c.json", R"({"name": "c", "name": "d", "coordinates": [{"name": "x", "unit": "m"}],
                                "lagrangian": "x_dot^2"})");
  directory.write("d.json", std::string(200'000, ' '));
  const std::string mistakes = mistakes_in(directory);
  EXPECT_NE(mistakes.find("a.json: /coordinates: "), std::string::npos) << mistakes;
  EXPECT_NE(mistakes.find("a.json: /bodies: "), std::string::npos) << mistakes;
  EXPECT_NE(mistakes.find("b.json: "), std::string::npos) << mistakes;
  EXPECT_NE(mistakes.find("c.json: /name: "), std::string::npos) << mistakes;
  EXPECT_NE(mistakes.find("d.json: "), std::string::npos) << mistakes;
}

TEST(Catalogue, RefusesANameThatIsTaken) {
  const Directory directory;
  directory.write("mine.json", cart_named("cart_pendulum"));
  directory.write("one.json", cart_named("same"));
  directory.write("two.json", cart_named("same"));
  EXPECT_EQ(mistakes_in(directory),
            "mine.json: /name: The name 'cart_pendulum' is taken by cart_pendulum.json.\n"
            "two.json: /name: The name 'same' is taken by one.json.\n");
}

TEST(Catalogue, SaysWhenADirectoryIsMissing) {
  EXPECT_THROW((void)Catalogue::built_in().with_directory("/no/such/place"), std::runtime_error);
}

TEST(Catalogue, SaysWhenAFileCannotBeRead) {
  const Directory directory;
  fs::create_directory(directory.path() / "folder.json");
  EXPECT_EQ(mistakes_in(directory), "folder.json: The file cannot be read.\n");
}

}  // namespace
}  // namespace qdot::api
