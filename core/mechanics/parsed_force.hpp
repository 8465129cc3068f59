#pragma once
// Springs, dampers, forces and torques with their texts read.
//
//   spring   V = k/2 (s - s0)^2                              s a length, a distance |B - A|, or an angle
//   damper   F = -c s' or -c |s'| s' along s; F = -c v or -c |v| v at a point
//   force    Q_i = F . dr/dq_i                               r a point, or one quantity that F pushes along
//   torque   Q_i = M . domega/dq_i'                          omega of a body, M in the axes of space
//
// The distance of two places has no direction where they meet: its slope is singular there unless s0 is 0.

#include <span>
#include <string>
#include <vector>

#include "core/mechanics/parsed_body.hpp"

namespace qdot {

struct ParsedSpring {
  Expression stiffness, length, rest_length;  ///< angles of a torsion spring
};
struct ParsedForce {
  Vector vector, point;  ///< of one component each where a force pushes along one quantity
};
struct ParsedTorque {
  Vector vector, angular_velocity;
};

/// Mistakes go to `text`.
[[nodiscard]] ParsedSpring parse_spring(const Spring& spring, const std::string& place, SceneText& text);

/// `rates` are the pairs (x, x') of everything that varies.
[[nodiscard]] ParsedForce parse_damper(const Damper& damper, const std::string& place, SceneText& text,
                                       std::span<const Replacement> rates);

[[nodiscard]] ParsedForce parse_force(const Force& force, const std::string& place, SceneText& text);

[[nodiscard]] ParsedTorque parse_torque(const Force& force, const std::string& place, SceneText& text,
                                        const std::vector<ParsedBody>& bodies,
                                        std::span<const Replacement> rates);

}  // namespace qdot
