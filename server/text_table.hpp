#pragma once
// Rows of cells as aligned text, and a picture of a column in one line.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace qdot::server {

using Cells = std::vector<std::string>;

/// How many columns of a terminal a text takes: one for each character, whatever its bytes.
[[nodiscard]] std::size_t width_of(std::string_view text);

/// Each column as wide as its widest cell, two blanks between; numbers stand at the right, words at the left.
[[nodiscard]] std::vector<std::string> aligned(const std::vector<Cells>& rows);

/// "▁▃▇█▆▂": at most `width` marks from the least value to the largest; empty where a value is not finite.
[[nodiscard]] std::string sparkline(std::span<const double> values, std::size_t width);

}  // namespace qdot::server
