#pragma once
// Walls that give back all of the speed: places at which the impacts of a scene with one coordinate turn its
// velocity round, x' -> -x'. Between them, and turning points, the motion goes to and fro as its energy
// integral says: a ball that bounces from h has the period 2 sqrt(2h/g).

#include <optional>
#include <string>

#include "core/mechanics/model.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

struct ElasticWall {
  std::string event;
  Ball place;
};

/// The nearest ones on either side of the start.
struct ElasticWalls {
  std::optional<ElasticWall> below, above;
};

/// Where w, linear in x with coefficients that stay as they are, vanishes; made in `graph`, a copy of the
/// model's. No value for other functions.
[[nodiscard]] std::optional<Expression> place_of_wall(Graph& graph, const Model& model, const Expression& w);

/// No value where an impact is of another kind, or the start lies at a wall and does not leave it.
[[nodiscard]] std::optional<ElasticWalls> elastic_walls(const Model& model, const Reals& parameters,
                                                        const Reals& y0);

}  // namespace qdot
