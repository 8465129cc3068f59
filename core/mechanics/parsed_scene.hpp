#pragma once
// A scene with its texts read into expressions: every symbol known, every dimension checked.

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/expr/calculus.hpp"
#include "core/expr/expression.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot {

/// A vector's 2 or 3 components in the inertial frame.
using Vector = std::vector<Expression>;

/// The symbols of a scene: q, q_dot, q_ddot in the order of its coordinates, the time t, and so on.
/// Inputs and held lengths vary in time too: x[i], x_dot[i] and x_ddot[i] stand for them and their
/// derivatives.
struct Symbols {
  struct Varying {
    std::vector<Expression> value, rate, second_rate;
  };
  Varying coordinates;
  Expression t;
  Varying inputs;
  Varying held;
  std::vector<Expression> parameters;

  /// (x, x') for everything that varies along a motion, the time with rate 1: the chain rule's d/dt.
  [[nodiscard]] std::vector<Replacement> rates() const;
};

struct ParsedParticle {
  Expression mass;
  Vector position;
};
struct ParsedRod {
  Expression mass;
  Vector start, end;
};
struct ParsedDisk {
  Expression mass, radius;
  Vector centre;
  Expression angle;
};
using ParsedBody = std::variant<ParsedParticle, ParsedRod, ParsedDisk>;

struct ParsedSpring {
  Expression stiffness, length, rest_length;
};
struct ParsedForce {
  Vector vector, point;
};
/// A reaction of the held length number `held`, or a plain quantity.
struct ParsedReaction {
  std::size_t held{};
  int sign{1};
};
using ParsedCondition = std::variant<ParsedReaction, Expression>;

struct ParsedSceneEvent {
  Expression value;
  std::optional<Expression> when;
};
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
  std::vector<ParsedForce> forces;
  std::vector<ParsedCondition> valid_while;
  std::vector<ParsedCondition> reports;
  std::vector<Expression> singular_where;
  std::vector<ParsedSceneEvent> events;
  std::vector<Replacement> impact;
  std::optional<ParsedScales> scales;
};

/// Reads all texts of a scene. Every mistake is added to `diagnostics`: syntax, unknown symbols, dimensions,
/// names used twice, missing parts. The result is complete only when there was none.
[[nodiscard]] ParsedScene parse_scene(const Scene& scene, std::vector<Diagnostic>& diagnostics);

}  // namespace qdot
