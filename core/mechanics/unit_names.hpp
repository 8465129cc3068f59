#pragma once
// The names that units have, and the words and signs that people write for them: "degrees", "°", "sec",
// "m/s²".

#include <string>
#include <string_view>
#include <vector>

#include "core/mechanics/dimension.hpp"

namespace qdot {

/// The unit of a name or of a word for it: "km", "deg", "degrees". Null where there is none.
[[nodiscard]] const Unit* find_unit(std::string_view name);

/// Signs beyond ASCII as unit expressions have them: "°" is deg, "²" ^2, "·" *, "µ" u, "Ω" ohm. What is no
/// sign of a unit stays as it is.
[[nodiscard]] std::string in_ascii(std::string_view text);

/// The names of units, without words for them.

/// The words for units, "degree", in the singular.
[[nodiscard]] std::vector<std::string> unit_words();

/// The name of the unit that a name or a word means, "deg"; empty where there is none.
[[nodiscard]] std::string unit_name_of(std::string_view word);

/// Those of a dimension, of which angles have one of their own here: km, m, cm, mm, um for m.
[[nodiscard]] std::vector<std::string> unit_names_like(const Unit& unit);

}  // namespace qdot
