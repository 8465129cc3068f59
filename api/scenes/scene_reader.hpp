#pragma once
// From the JSON form of a scene to the Scene that core computes with.
//
// The JSON form has exactly the fields of core/mechanics/scene.hpp, in api/scenes/schema.json's words:
//
//   "parameters":   [{"name": "l", "unit": "m", "default": "0.5", "domain": "> 0", "meaning":
//   "length"}] "coordinates":  [{"name": "theta", "unit": "rad", "initial": "pi/6", "initial_rate": "0"}]
//   "points":       [{"name": "bob", "components": ["l*sin(theta)", "-l*cos(theta)"]}]
//   "bodies":       [{"kind": "particle", "name": "bob", "mass": "m", "position": "bob"}]
//   "gravity":      ["0", "-g"]
//   "springs":      [{"stiffness": "k", "length": "x", "rest_length": "0"}]
//   "valid_while":  [{"name": "tension", "unit": "N", "reaction": {"length": "s", "sign": -1}, ...}]
//
// An expression is a string, or a number where that says it: 0, 1.5. A position is the name of a point or an
// array of 2 or 3 expressions. A domain is text, "> 0" or "> 0, <= 1".
//
// Only structure is looked at here: fields, types, names, sizes. What an expression means, whether its
// symbols exist and its dimensions agree, and whether names are used twice, core says (core/mechanics).

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// The largest scene that is read. An expression has at most limits::expression_bytes, a name
/// limits::name_bytes.
namespace scene_limits {
inline constexpr std::size_t parameters = 32;
inline constexpr std::size_t coordinates = 8;
inline constexpr std::size_t inputs = 8;
inline constexpr std::size_t held_lengths = 8;
inline constexpr std::size_t points = 64;
inline constexpr std::size_t bodies = 16;
inline constexpr std::size_t springs = 16;
inline constexpr std::size_t forces = 16;
inline constexpr std::size_t conditions = 8;  ///< valid_while, reports, singular_where, each
inline constexpr std::size_t events = 16;
inline constexpr std::size_t map_entries = 32;   ///< impact.map, scales.names, each
inline constexpr std::size_t lines = 32;         ///< and points in one line
inline constexpr std::size_t text_bytes = 1000;  ///< title, description, meaning, message
}  // namespace scene_limits

struct SceneReading {
  Scene scene;                          ///< complete only when there are no diagnostics
  std::vector<Diagnostic> diagnostics;  ///< every mistake, at most limits::listed_errors of them
};

/// Never throws on account of what `json` says.
[[nodiscard]] SceneReading read_scene(const Json& json);

/// May this name a parameter, a coordinate, a point? ASCII letters, digits and underscores after a letter, at
/// most limits::name_bytes; not ending in _dot or _ddot, which say velocity and acceleration, and none of
/// reserved_names().
[[nodiscard]] bool is_scene_name(std::string_view text);

/// t, pi and the functions that expressions know.
[[nodiscard]] const std::vector<std::string>& reserved_names();

}  // namespace qdot::api
