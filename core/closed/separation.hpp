#pragma once
// Which of several conditions keep a claim from the places where it does not hold.

#include <cstddef>
#include <optional>
#include <vector>

namespace qdot {

/// `broken`: a row for each condition, the simplest first, of the places at which it is not true. `holds`:
/// whether the claim is true at each place; none where nothing is claimed. The numbers of conditions one of
/// which is broken wherever the claim does not hold: as few as are found, and such as are broken where it
/// holds only where there are no others. None where they do not suffice.
[[nodiscard]] std::optional<std::vector<std::size_t>> separating(const std::vector<std::vector<bool>>& broken,
                                                                 const std::vector<bool>& holds);

}  // namespace qdot
