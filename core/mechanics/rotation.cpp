#include "core/mechanics/rotation.hpp"

#include <algorithm>
#include <string_view>

#include "core/expr/special_angles.hpp"

namespace qdot {
namespace {

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Vector times(const Expression& factor, const Vector& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

/// v turned about a unit vector by the angle that has this cosine and sine.
Vector turned_once(const Vector& n, const Expression& cosine, const Expression& sine, const Vector& v) {
  const Expression share = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
  const Vector along = times(share, n);
  const Vector across{v[0] - along[0], v[1] - along[1], v[2] - along[2]};
  return plus(plus(along, times(cosine, across)), times(sine, cross(n, v)));
}

/// A quarter of a turn leaves no cos(pi/2).
Expression cosine(const Turn& turn) { return with_special_angles(cos(turn.angle)); }
Expression sine(const Turn& turn) { return with_special_angles(sin(turn.angle)); }

Vector zero(Graph& graph) { return Vector(3, graph.number(0)); }

}  // namespace

Vector turned(std::span<const Turn> turns, const Vector& v) {
  Vector result = v;
  for (auto turn = turns.rbegin(); turn != turns.rend(); ++turn)
    result = turned_once(turn->axis, cosine(*turn), sine(*turn), result);
  return result;
}

Vector body_angular_velocity(Graph& graph, std::span<const Turn> turns, std::span<const Replacement> rates) {
  Vector omega = zero(graph);
  for (const Turn& turn : turns) {
    omega = turned_once(turn.axis, cosine(turn), -sine(turn), omega);
    omega = plus(omega, times(total_derivative(turn.angle, rates), turn.axis));
  }
  return omega;
}

Vector space_angular_velocity(Graph& graph, std::span<const Turn> turns, std::span<const Replacement> rates) {
  Vector omega = zero(graph);
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const Vector axis = turned(turns.first(k), turns[k].axis);
    omega = plus(omega, times(total_derivative(turns[k].angle, rates), axis));
  }
  return omega;
}

std::optional<TurnSequence> turn_sequence(const std::string& letters) {
  constexpr std::string_view capitals = "XYZ", small = "xyz";
  TurnSequence result;
  result.backwards = small.find(letters.front()) != std::string_view::npos;
  const std::string_view alphabet = result.backwards ? small : capitals;
  for (const char letter : letters) {
    const std::size_t axis = alphabet.find(letter);
    if (axis == std::string_view::npos) return std::nullopt;
    result.axes.push_back(axis);
  }
  if (result.backwards) std::ranges::reverse(result.axes);
  return result;
}

}  // namespace qdot
