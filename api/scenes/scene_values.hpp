#pragma once
// Readers of the single values in a scene: names, expressions, prose, positions, domains. Each fills its
// target or reports what is wrong with the value and what to write instead.

#include <string>
#include <utility>
#include <vector>

#include "api/scenes/scene_fields.hpp"

namespace qdot::api {

/// A name that expressions can use, see is_scene_name.
void read_name(const Cursor& cursor, std::string& target);

/// A reference to such a name, or to its velocity: "theta", "theta_dot".
void read_symbol(const Cursor& cursor, std::string& target);

/// Short text without line breaks: a unit, a version, LaTeX.
void read_word(const Cursor& cursor, std::string& target);

/// A sentence or two.
void read_prose(const Cursor& cursor, std::string& target);

/// Text that core/expr parses later; a JSON number is taken over as its shortest text.
void read_expression(const Cursor& cursor, std::string& target);

/// 2 or 3 expressions.
void read_vector(const Cursor& cursor, std::vector<std::string>& target);

/// The name of a point, or a vector.
void read_position(const Cursor& cursor, Position& target);

/// "> 0", ">= 0", "> 0, <= 1": one bound or two, each a number.
void read_domain(const Cursor& cursor, Domain& target);

/// 1 or -1.
void read_sign(const Cursor& cursor, int& target);

/// "rising", "falling" or "either".
void read_crossing(const Cursor& cursor, Crossing& target);

/// An object symbol -> expression, in its order.
void read_map(const Cursor& cursor, std::vector<std::pair<std::string, std::string>>& target);

/// An object parameter -> another name for it, in its order.
void read_new_names(const Cursor& cursor, std::vector<std::pair<std::string, std::string>>& target);

}  // namespace qdot::api
