// From scene file to compiled model, cold: read, check, derive, compile q''.

#include <benchmark/benchmark.h>

#include "api/scenes/catalogue.hpp"
#include "api/scenes/scene_reader.hpp"
#include "core/dynamics/dynamics.hpp"

namespace qdot {
namespace {

void build(const std::string& text) {
  const api::SceneReading reading = api::read_scene(api::Json::parse(text));
  const Dynamics dynamics(build_model(reading.scene));
  benchmark::DoNotOptimize(&dynamics.accelerations());
}

void models_one(benchmark::State& state) {
  const api::Catalogue catalogue = api::Catalogue::built_in();
  const api::CatalogueEntry& entry = catalogue.entries()[static_cast<std::size_t>(state.range(0))];
  const std::string text = entry.json.dump();
  state.SetLabel(entry.scene.name);
  for (auto _ : state) build(text);
}

void models_all_eleven(benchmark::State& state) {
  const api::Catalogue catalogue = api::Catalogue::built_in();
  std::vector<std::string> texts;
  for (const api::CatalogueEntry& entry : catalogue.entries()) texts.push_back(entry.json.dump());
  for (auto _ : state) {
    for (const std::string& text : texts) build(text);
  }
}

BENCHMARK(models_one)->DenseRange(0, 10)->Unit(benchmark::kMicrosecond);
BENCHMARK(models_all_eleven)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace qdot
