#pragma once
// What the tables of scenes have in common: the sizes of a scene, its kinds of text, and how values become
// members of core's structs.

#include <cstddef>

#include "api/contract/table.hpp"
#include "api/json/limits.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot {

/// The name of a point, or components.
void from_json(const api::Json& json, Position& position);

/// A text that api::parse_domain has accepted.
void from_json(const api::Json& json, Domain& domain);

}  // namespace qdot

namespace qdot::api {

/// The largest scene that is read. An expression has at most limits::expression_bytes, a name
/// limits::name_bytes.
namespace scene_limits {
inline constexpr std::size_t parameters = 32;
inline constexpr std::size_t coordinates = 12;
inline constexpr std::size_t inputs = 8;
inline constexpr std::size_t held_lengths = 8;
inline constexpr std::size_t constraints = 8;
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

/// A unit, a version, LaTeX.
inline constexpr TextKind short_text{limits::name_bytes, Ends::as_given};

/// A sentence or two.
inline constexpr TextKind prose{scene_limits::text_bytes, Ends::as_given};

}  // namespace qdot::api
