#include "tests/support/scenes.hpp"

#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>

#include "api/scenes/scene_reader.hpp"
#include "tests/support/files.hpp"

namespace qdot::test {

const std::vector<std::string>& practice_systems() {
  static const std::vector<std::string> names{
      "spring_pendulum",    "forced_spring_pendulum", "rolling_disk_platform", "cart_pendulum",
      "rod_pendulum",       "rod_spring_pendulum",    "whirling_pendulum",     "orbiting_pendulum",
      "free_spin_pendulum", "compass_walker",         "rotating_l_bar"};
  return names;
}

const std::vector<std::string>& textbook_systems() {
  static const std::vector<std::string> names{
      "plane_pendulum", "spherical_pendulum", "kepler",          "driven_pivot",      "atwood",
      "bead_on_hoop",   "foucault",           "triple_pendulum", "damped_oscillator", "magnetic_particle"};
  return names;
}

Scene scene_of(const std::string& name) {
  const std::string built_in = "api/scenes/systems/" + name + ".json";
  const bool is_built_in = std::filesystem::exists(std::string(QDOT_SOURCE_DIR "/") + built_in);
  const std::string path = is_built_in ? built_in : "tests/reference/scenes/" + name + ".json";
  const api::SceneReading reading = api::read_scene(json_file(path));
  if (!reading.errors.empty()) throw std::runtime_error(path + ": " + reading.errors[0].detail);
  return reading.scene;
}

std::shared_ptr<const Model> model_of(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const Model>> models;
  const std::lock_guard lock(mutex);
  std::shared_ptr<const Model>& model = models[name];
  if (!model) model = build_model(scene_of(name));
  return model;
}

std::shared_ptr<const Model> model_written(const std::string& json) {
  const api::SceneReading reading = api::read_scene(api::Json::parse(json));
  if (!reading.errors.empty()) throw std::runtime_error(reading.errors[0].detail);
  return build_model(reading.scene);
}

}  // namespace qdot::test
