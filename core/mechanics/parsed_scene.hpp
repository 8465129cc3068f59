#pragma once
// A scene with its texts read into expressions: every symbol known, every dimension checked.

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/mechanics/exponents.hpp"
#include "core/mechanics/followers.hpp"
#include "core/mechanics/parsed_body.hpp"
#include "core/mechanics/parsed_force.hpp"
#include "core/mechanics/parsed_impact.hpp"
#include "core/mechanics/scene.hpp"
#include "core/mechanics/symbols.hpp"

namespace qdot {

struct ParsedConstraint {
  Expression expression;
  bool holonomic{};             ///< no velocity stands in it
  std::string multiplier_unit;  ///< J over the expression's, or W where it has velocities
};
/// A reaction of the held length number `held`, or a plain quantity.
struct ParsedReaction {
  std::size_t held{};
  int sign{1};
};
using ParsedCondition = std::variant<ParsedReaction, Expression>;

struct ParsedScales {
  Expression mass, length, time;
};

struct ParsedScene {
  std::shared_ptr<Graph> graph = std::make_shared<Graph>();
  Symbols symbols;
  std::vector<Expression> parameter_defaults;
  std::vector<Expression> initial, initial_rates;
  std::vector<Expression> input_defaults;
  std::vector<Expression> held_values;
  std::vector<Vector> points;
  std::vector<ParsedBody> bodies;
  Vector gravity;
  std::vector<ParsedSpring> springs;
  std::optional<Expression> potential, dissipation, lagrangian;
  std::vector<ParsedForce> forces;  ///< those of dampers too
  std::vector<ParsedTorque> torques;
  std::vector<ParsedConstraint> constraints;
  std::vector<ParsedCondition> valid_while;
  std::vector<ParsedCondition> reports;
  std::vector<Expression> singular_where;
  std::vector<ParsedSceneEvent> events;
  std::vector<ParsedImpact> impacts;
  std::optional<ParsedScales> scales;
  FoundExponents exponents;
};

/// Reads all texts of a scene. Every mistake is added to `diagnostics`: syntax, unknown symbols, dimensions,
/// names used twice, missing parts. The result is complete only when there was none. `exponents`: values of
/// parameters that are exponents (exponents.hpp). `followers`: parameters that others are put in for.
[[nodiscard]] ParsedScene parse_scene(const Scene& scene, std::vector<Diagnostic>& diagnostics,
                                      const ExponentValues& exponents = {}, const Followers& followers = {});

}  // namespace qdot
