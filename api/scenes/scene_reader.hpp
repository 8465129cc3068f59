#pragma once
// From the JSON form of a scene to the Scene that core computes with.
//
// The JSON form has exactly the fields of core/mechanics/scene.hpp, as scene_table.hpp lists them and
// GET /v1/scene-schema describes them:
//
//   "parameters":   [{"name": "l", "unit": "m", "default": "0.5", "domain": "> 0", "meaning": "length"}]
//   "coordinates":  [{"name": "theta", "unit": "rad", "initial": "pi/6", "initial_rate": "0"}]
//   "points":       [{"name": "bob", "components": ["l*sin(theta)", "-l*cos(theta)"]}]
//   "bodies":       [{"kind": "particle", "name": "bob", "mass": "m", "position": "bob"}]
//   "gravity":      ["0", "-g"]
//   "springs":      [{"stiffness": "k", "length": "x", "rest_length": "0"}]
//   "valid_while":  [{"name": "tension", "unit": "N", "reaction": {"length": "s", "sign": -1}, ...}]
//
// An expression is a text, or a number where that says it: 0, 1.5. A position is the name of a point or an
// array of 2 or 3 expressions. A domain is a text, "> 0" or "> 0, <= 1".
//
// Only structure is looked at here: fields, types, names, sizes. What an expression means, whether its
// symbols exist and its dimensions agree, and whether names are used twice, core says (core/mechanics).

#include "api/contract/field_values.hpp"
#include "api/contract/submission.hpp"
#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

struct SceneReading {
  Scene scene;      ///< complete only when there are no errors
  Errors errors{};  ///< every mistake with its place, of very many the first few
};

/// Never throws on account of what `json` says. `place` is where the scene is in what was sent.
[[nodiscard]] SceneReading read_scene(const Json& json, const Place& place = Place::of_document());

}  // namespace qdot::api
