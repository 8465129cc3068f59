#include "core/grading/equation_labels.hpp"

#include <algorithm>
#include <span>

namespace qdot {
namespace {

using Tokens = std::span<const StudentToken>;

bool is_mark(Tokens line, std::size_t at, Mark mark) { return at < line.size() && line[at].mark == mark; }

bool is_count(Tokens line, std::size_t at, std::size_t count) {
  return is_mark(line, at, Mark::number) && line[at].value == Number(static_cast<long>(count));
}

/// The tokens of "x:" at the beginning of a line.
std::size_t length_of_name(Tokens line) {
  constexpr std::size_t longest = 6;
  const auto colon = std::ranges::find(line, Mark::colon, &StudentToken::mark);
  const auto length = static_cast<std::size_t>(colon - line.begin());
  const bool is_name = std::all_of(line.begin(), colon, [](const StudentToken& token) {
    return token.mark == Mark::name || token.mark == Mark::number || token.mark == Mark::open ||
           token.mark == Mark::close;
  });
  return colon == line.end() || length > longest || !is_name ? 0 : length + 1;
}

/// The tokens of "(2)", "2)", "2." or "b)" at the beginning of line number `count`.
std::size_t length_at_beginning(Tokens line, std::size_t count) {
  if (is_mark(line, 0, Mark::open) && is_count(line, 1, count) && is_mark(line, 2, Mark::close)) return 3;
  if (is_count(line, 0, count) && is_mark(line, 1, Mark::close)) return 2;
  if (is_mark(line, 0, Mark::name) && is_mark(line, 1, Mark::close)) return 2;
  const bool is_point =
      is_count(line, 0, count) && line[0].text.ends_with('.') && line.size() > 1 && line[1].is_apart;
  return is_point ? 1 : 0;
}

/// The tokens of "(2)" at the end of line number `count`, apart from what stands before it.
std::size_t length_at_end(Tokens line, std::size_t count) {
  if (line.size() < 4) return 0;
  const Tokens last = line.last(3);
  const bool is_label =
      is_mark(last, 0, Mark::open) && is_count(last, 1, count) && is_mark(last, 2, Mark::close);
  return is_label && last[0].is_apart ? 3 : 0;
}

std::vector<Tokens> lines_of(Tokens tokens) {
  std::vector<Tokens> lines;
  std::size_t first = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const bool ends = tokens[i].mark == Mark::line || tokens[i].mark == Mark::end;
    if (!ends) continue;
    if (i > first) lines.push_back(tokens.subspan(first, i - first));
    first = i + 1;
  }
  return lines;
}

/// The lines without what `length` finds at one end of each; as they are where one has nothing there.
template <class Length, class Cut>
void cut_if_all(std::vector<Tokens>& lines, const Length& length, const Cut& cut) {
  std::vector<Tokens> shorter;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t label = length(lines[i], i + 1);
    if (label == 0 || label == lines[i].size()) return;
    shorter.push_back(cut(lines[i], label));
  }
  lines = std::move(shorter);
}

}  // namespace

std::vector<StudentToken> without_labels(const std::vector<StudentToken>& tokens) {
  std::vector<Tokens> lines = lines_of(tokens);
  const auto from = [](Tokens line, std::size_t label) { return line.subspan(label); };
  const auto until = [](Tokens line, std::size_t label) { return line.first(line.size() - label); };
  for (Tokens& line : lines) line = from(line, length_of_name(line));
  cut_if_all(lines, length_at_beginning, from);
  cut_if_all(lines, length_at_end, until);
  std::vector<StudentToken> rest;
  for (const Tokens line : lines) {
    rest.insert(rest.end(), line.begin(), line.end());
    rest.push_back({.mark = Mark::line, .text = "\n", .offset = line.empty() ? 0 : line.back().offset});
  }
  if (!rest.empty()) rest.pop_back();
  rest.push_back(tokens.back());
  return rest;
}

}  // namespace qdot
