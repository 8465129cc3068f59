// A scene is read and derived, or refused with places in it.

#include "api/contract/json_reader.hpp"
#include "api/scenes/scene_reader.hpp"
#include "core/base/work.hpp"
#include "core/mechanics/model.hpp"
#include "tests/fuzz/law.hpp"

namespace {

using namespace qdot;

void check(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics) {
    fuzz::require(!diagnostic.code.empty() && !diagnostic.message.empty(), "a diagnostic says something");
    fuzz::require(diagnostic.place.empty() || diagnostic.place[0] == '/', "its place is a JSON Pointer");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 1500) return 0;  // small scenes show the same and are derived in a moment
  const auto read = api::read_json(fuzz::text_of(data, size));
  const auto* document = std::get_if<api::JsonDocument>(&read);
  if (document == nullptr) return 0;
  const api::SceneReading reading = api::read_scene(document->value);
  for (const api::FieldError& error : reading.errors) {
    fuzz::require(!error.code.empty() && !error.detail.empty(), "an error says something");
    fuzz::require(error.pointer.starts_with("#"), "its place is a JSON Pointer");
  }
  if (!reading.errors.empty()) return 0;
  try {
    const WorkScope work(fuzz::algebra);
    const auto model = build_model(reading.scene);
    fuzz::require(model->degrees_of_freedom() > 0, "a model moves");
  } catch (const SceneError& error) {
    fuzz::require(!error.diagnostics().empty(), "a scene is refused for a reason");
    check(error.diagnostics());
  } catch (const Error& error) {
    fuzz::require(*error.what() != '\0', "an error has a sentence");
  }
  return 0;
}
