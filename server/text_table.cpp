#include "server/text_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace qdot::server {
namespace {

bool is_number(std::string_view text) {
  double value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string padded(const std::string& cell, std::size_t width) {
  const std::string blanks(width - std::min(width, width_of(cell)), ' ');
  return is_number(cell) ? blanks + cell : cell + blanks;
}

}  // namespace

std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::string> aligned(const std::vector<Cells>& rows) {
  std::vector<std::size_t> widths;
  for (const Cells& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::vector<std::string> lines;
  for (const Cells& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += (i == 0 ? "" : "  ") + padded(row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string sparkline(std::span<const double> values, std::size_t width) {
  constexpr std::array marks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  if (values.empty() || !std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) return {};
  const auto [least, largest] = std::ranges::minmax(values);
  const double span = largest - least;
  const std::size_t count = std::min(width, values.size());
  std::string line;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = values[i * values.size() / count];
    const double height = span > 0 && std::isfinite(span) ? (value - least) / span : 0.5;
    line += marks[std::min<std::size_t>(7, static_cast<std::size_t>(height * 8))];
  }
  return line;
}

}  // namespace qdot::server
