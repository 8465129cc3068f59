#pragma once
// Systems of first order: "theta' = omega; omega' = -g/l sin theta" gives the velocity a name first.

#include <string>
#include <string_view>

#include "core/grading/vocabulary.hpp"

namespace qdot {

/// The lines of `text` without those that only name a velocity, omega = theta' or the other way round; the
/// names are added to the vocabulary. Throws as plain_notation does.
[[nodiscard]] std::string without_definitions(std::string_view text, const Symbols& symbols,
                                              Vocabulary& vocabulary);

}  // namespace qdot
