#include "core/motion/extended_impacts.hpp"

#include <algorithm>
#include <memory>

#include "core/motion/extended_pieces.hpp"
#include "core/motion/impact_map.hpp"

namespace qdot {
namespace {

/// One of the scene's impacts.
struct Passage {
  ImpactMap map;
  CompiledFunction event;
  std::shared_ptr<const CompiledFunction> components;
  ExtendedFunction event_at, components_at;

  Passage(const Dynamics& dynamics, const ParsedImpact& impact, std::span<const DoubleDouble> parameters)
      : map(impact_map(dynamics.model(), impact)),
        event(dynamics.event(impact.event).value),
        components(dynamics.columns(map.components)),
        event_at(event, parameters),
        components_at(*components, parameters) {}
};

}  // namespace

std::optional<ExtendedRun> extended_states_through(std::span<const SectionRecord> sections,
                                                   const Dynamics& dynamics,
                                                   const ExtendedMotionRequest& request) {
  const auto is_one = [](const SectionRecord& section) { return section.impacts.size() == 1; };
  if (!std::ranges::all_of(sections, is_one)) return std::nullopt;
  std::vector<std::unique_ptr<Passage>> passages;
  for (const ParsedImpact& impact : dynamics.model().parsed.impacts) {
    passages.push_back(std::make_unique<Passage>(dynamics, impact, request.parameters));
  }
  const ExtendedSystem system = extended_system(dynamics.accelerations(), request);
  ExtendedPieces pieces(request);
  for (const SectionRecord& section : sections) {
    Passage& passage = *passages[section.impacts.front()];
    const auto event = [&](const DoubleDouble& t, std::span<const DoubleDouble> y) {
      return passage.event_at(t, y).front();
    };
    if (!pieces.go_to(system, section.t) || !pieces.jump_at_zero(system, event, section.duration)) {
      return std::nullopt;
    }
    passage.map.assign(passage.components_at(pieces.t(), pieces.y()), pieces.y());
  }
  if (!pieces.finish(system)) return std::nullopt;
  return std::move(pieces).run();
}

}  // namespace qdot
