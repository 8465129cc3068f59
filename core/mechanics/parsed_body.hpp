#pragma once
// A body of a scene with its texts read. Whatever its kind, its kinetic energy is
//
//   T = m/2 v.v + sum of I/2 w^2    v the centre's velocity, (I, w) its spins
//
// A particle has no spins; a slender rod has the components of vB - vA, each with m/12, which is
// m/6 (vA.vA + vA.vB + vB.vB) in all; a body in the plane has its moment of inertia and its angle's rate; one
// in space the three principal moments and the components of its angular velocity in its own axes
// (rotation.hpp).

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mechanics/rotation.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot {

class SceneText;

struct ParsedSpin {
  Expression inertia;  ///< I
  Expression rate;     ///< w
  /// What I has more about the end of the rod, or about the rim on which the body rolls; 0 without one.
  Expression more_at_end;
};

struct ParsedBody {
  std::string name;
  Expression mass;
  Vector centre;
  std::vector<ParsedSpin> spins;
  std::optional<Expression> angle;  ///< of a body that turns in the plane
  std::vector<Turn> turns;          ///< of a body that turns in space
  /// Places that it carries, which show how it moves: the ends of a rod, the centre and, in space, the ends
  /// of its axes of length 1.
  std::vector<Vector> marks;
};

/// Mistakes go to `text`.
[[nodiscard]] ParsedBody parse_body(const Body& body, const std::string& place, SceneText& text, Graph& graph,
                                    std::span<const Replacement> rates);

}  // namespace qdot
