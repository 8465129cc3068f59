#include "core/symmetry/motion_in_space.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

using Kind = MotionInSpace::Kind;

/// dr of each place.
std::vector<Vector> displacements(const std::vector<Vector>& places, const Symbols& symbols,
                                  const PointChange& change) {
  std::vector<Vector> result;
  for (const Vector& place : places) {
    result.emplace_back();
    for (const Expression& component : place) {
      std::vector<Expression> terms;
      for (std::size_t i = 0; i < change.shift.size(); ++i)
        terms.push_back(differentiate(component, symbols.coordinates.value[i]) * change.shift[i]);
      result.back().push_back(simplify(component.graph().sum(terms)));
    }
  }
  return result;
}

/// The vector that all of them are, if it depends on no place and no time.
std::optional<Vector> common_constant(const std::vector<Vector>& vectors, const Symbols& symbols) {
  const bool is_common =
      std::ranges::all_of(vectors, [&](const Vector& v) { return std::ranges::equal(v, vectors[0]); });
  const bool is_constant = std::ranges::none_of(vectors[0], [&](const Expression& e) {
    return depends_on(e, symbols.t) || depends_on(e, symbols.coordinates.value);
  });
  return is_common && is_constant ? std::optional(vectors[0]) : std::nullopt;
}

/// The only component that is not zero.
std::optional<std::size_t> axis_of(const Vector& v) {
  std::optional<std::size_t> axis;
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (v[k].is_zero()) continue;
    if (axis) return std::nullopt;
    axis = k;
  }
  return axis;
}

std::optional<MotionInSpace> straight(const std::vector<Vector>& displaced, const Symbols& symbols,
                                      Kind kind) {
  const auto direction = common_constant(displaced, symbols);
  const auto axis = direction ? axis_of(*direction) : std::nullopt;
  if (!axis) return std::nullopt;
  return MotionInSpace{kind, *axis, split_coefficient((*direction)[*axis]).coefficient.is_negative()};
}

/// e_axis x r; in a plane the axis is perpendicular to it.
Vector turned(const Vector& r, std::size_t axis) {
  if (r.size() == 2) return {-r[1], r[0]};
  Vector result(3, r[0].graph().number(0));
  result[(axis + 1) % 3] = -r[(axis + 2) % 3];
  result[(axis + 2) % 3] = r[(axis + 1) % 3];
  return result;
}

std::optional<MotionInSpace> rotation(const std::vector<Vector>& places, const std::vector<Vector>& displaced,
                                      const Symbols& symbols, std::size_t axis, const Expression& scale) {
  std::vector<Vector> rest;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const Vector around = turned(places[p], axis);
    rest.emplace_back();
    for (std::size_t k = 0; k < around.size(); ++k)
      rest.back().push_back(simplify(displaced[p][k] - scale * around[k]));
  }
  const auto constant = common_constant(rest, symbols);
  if (!constant) return std::nullopt;
  const bool along = constant->size() == 3 && !(*constant)[axis].is_zero();
  if (std::ranges::all_of(*constant, [](const Expression& e) { return e.is_zero(); }))
    return MotionInSpace{Kind::rotation, axis};
  if (!along) return MotionInSpace{Kind::offset_rotation, axis};
  return axis_of(*constant) ? std::optional(MotionInSpace{Kind::screw, axis}) : std::nullopt;
}

}  // namespace

std::vector<Vector> places_of_bodies(const ParsedScene& scene, const Lagrangian& lagrangian,
                                     std::span<const Replacement> replacements) {
  Graph& graph = *lagrangian.graph;
  std::vector<Replacement> own;
  for (const auto& [symbol, value] : replacements) own.emplace_back(graph.adopt(symbol), graph.adopt(value));
  std::vector<Vector> places;
  const auto add = [&](const Vector& place) {
    places.emplace_back();
    for (const Expression& component : place)
      places.back().push_back(substitute(substitute(graph.adopt(component), lagrangian.holding), own));
  };
  for (const ParsedBody& body : scene.bodies) {
    for (const Vector& mark : body.marks) add(mark);
    if (!body.angle) continue;
    const Expression angle = graph.adopt(*body.angle);
    add({graph.adopt(body.centre[0]) + cos(angle), graph.adopt(body.centre[1]) + sin(angle)});
  }
  return places;
}

std::optional<MotionInSpace> motion_in_space(const std::vector<Vector>& places, const Symbols& symbols,
                                             const PointChange& change, const Expression& scale) {
  if (places.empty() || !change.time.is_zero()) return std::nullopt;
  const std::vector<Vector> displaced = displacements(places, symbols, change);
  if (auto found = straight(displaced, symbols, Kind::translation)) return found;
  std::vector<Vector> rates = displaced;
  for (Vector& v : rates) {
    for (Expression& component : v) component = simplify(component / symbols.t);
  }
  if (auto found = straight(rates, symbols, Kind::uniform)) return found;
  const bool is_plane = places[0].size() == 2;
  for (std::size_t axis = is_plane ? 2 : 0; axis < 3; ++axis) {
    if (auto found = rotation(places, displaced, symbols, axis, scale)) return found;
    if (auto found = rotation(places, displaced, symbols, axis, -scale)) {
      found->reversed = true;
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace qdot
