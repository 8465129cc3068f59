#pragma once
// Impacts read into expressions: a map of the state, or what it is derived from (impacts.hpp).

#include <optional>
#include <string>
#include <vector>

#include "core/mechanics/scene.hpp"
#include "core/mechanics/symbols.hpp"

namespace qdot {

class SceneText;

struct ParsedSceneEvent {
  Expression value;
  std::optional<Expression> when;
};
/// What an impact is derived from where its map is not written.
struct ParsedContact {
  std::optional<Expression> restitution;
  Expression distance;  ///< the event's expression
  Expression rate;      ///< its derivative by the time, of an impact with restitution
  Vector made, left;    ///< places of the points of contact, of one without
  std::vector<Replacement> renamed;
};
struct ParsedImpact {
  std::string event;
  std::string place;             ///< in the scene, "/impacts/1"
  std::vector<Replacement> map;  ///< the state after it, written or derived
  std::optional<ParsedContact> contact;

  /// Whether it is a push along the slope of a distance.
  [[nodiscard]] bool has_restitution() const { return contact && contact->restitution; }
};

/// All impacts of the scene, in order; its events are `events`. Mistakes go to `text`.
[[nodiscard]] std::vector<ParsedImpact> parse_impacts(const Scene& scene, const Symbols& symbols,
                                                      const std::vector<ParsedSceneEvent>& events,
                                                      SceneText& text);

}  // namespace qdot
