#include "api/json/suggest.hpp"

#include <algorithm>
#include <vector>

#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t largest_distance = 2;
constexpr std::size_t longest_word = 64;  ///< the cost is the product of two lengths

bool swapped(std::string_view a, std::string_view b, std::size_t i, std::size_t j) {
  return i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
}

}  // namespace

std::size_t edit_distance(std::string_view first, std::string_view second) {
  const std::string a = lower_case(first);
  const std::string b = lower_case(second);
  // Row i holds the distances between the first i letters of a and the first j letters of b.
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (swapped(a, b, i, j)) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string closest(std::string_view word, std::span<const std::string> candidates) {
  std::string nearest;
  std::size_t least = largest_distance + 1;
  if (word.size() > longest_word) return nearest;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > word.size() + largest_distance) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && distance < std::max(word.size(), candidate.size())) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace qdot::api
