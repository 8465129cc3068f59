#include "api/json/suggest.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr auto greek = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"θ", "theta"}, {"ϑ", "theta"}, {"φ", "phi"},     {"ϕ", "phi"},   {"ψ", "psi"},   {"ω", "omega"},
    {"Ω", "Omega"}, {"α", "alpha"}, {"β", "beta"},    {"γ", "gamma"}, {"δ", "delta"}, {"λ", "lambda"},
    {"μ", "mu"},    {"ρ", "rho"},   {"τ", "tau"},     {"χ", "chi"},   {"η", "eta"},   {"ξ", "xi"},
    {"π", "pi"},    {"Δ", "Delta"}, {"ε", "epsilon"}, {"σ", "sigma"}, {"κ", "kappa"}, {"ζ", "zeta"},
    {"−", "-"},     {"–", "-"},     {"Ω", "Omega"},
});

constexpr std::size_t largest_distance = 2;
constexpr std::size_t shortest_part = 3;  ///< of a name, that stands for the whole
constexpr std::size_t longest_word = 64;  ///< the cost is the product of two lengths

bool swapped(std::string_view a, std::string_view b, std::size_t i, std::size_t j) {
  return i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
}

/// Does `name` have `word` between its underscores? "compass_walker" has "walker".
bool has_part(std::string_view name, std::string_view word) {
  for (std::size_t at = name.find(word); at != std::string_view::npos; at = name.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || name[at - 1] == '_') && (end == name.size() || name[end] == '_')) return true;
  }
  return false;
}

/// The only candidate that begins with `word` or has it as a part; empty where there are several.
std::string only_longer(std::string_view word, std::span<const std::string> candidates) {
  const std::string start = lower_case(word);
  std::string found;
  if (start.size() < shortest_part) return found;
  for (const std::string& candidate : candidates) {
    const std::string name = lower_case(candidate);
    if (!name.starts_with(start) && !has_part(name, start)) continue;
    if (!found.empty()) return {};
    found = candidate;
  }
  return found;
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

std::string greek_by_name(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto letter = std::ranges::find_if(greek, [&](const auto& g) { return text.starts_with(g.first); });
    if (letter == greek.end()) {
      result += text.front();
      text.remove_prefix(1);
    } else {
      result += letter->second;
      text.remove_prefix(letter->first.size());
    }
  }
  return result;
}

std::string letters_of(std::string_view name) {
  std::string result = greek_by_name(name);
  std::erase_if(result, [](unsigned char c) { return c >= 128 || std::isalnum(c) == 0; });
  return result;
}

std::string same_letters(std::string_view name, std::span<const std::string> candidates) {
  const std::string word = letters_of(name);
  const std::string lower = lower_case(word);
  std::string found;
  if (word.empty() || name.size() > longest_word) return found;
  for (const std::string& candidate : candidates) {
    const std::string other = letters_of(candidate);
    if (other == word) return candidate;
    if (found.empty() && lower_case(other) == lower) found = candidate;
  }
  return found;
}

namespace {

/// xd, dx, vx, x_t for x_dot.
std::string velocity_written_otherwise(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::string_view ending = "_dot";
  for (const std::string& candidate : candidates) {
    if (!candidate.ends_with(ending)) continue;
    const std::string x = candidate.substr(0, candidate.size() - ending.size());
    for (const std::string& other : {x + "d", x + "_d", x + "t", x + "_t", x + "p", x + "_p", x + "prime",
                                     "d" + x, "D" + x, "v" + x, "v_" + x, "D_" + x}) {
      if (word == other) return candidate;
    }
  }
  return "";
}

}  // namespace

std::string closest(std::string_view word, std::span<const std::string> candidates) {
  std::string nearest = same_letters(word, candidates);
  if (nearest.empty()) nearest = velocity_written_otherwise(word, candidates);
  std::size_t least = largest_distance + 1;
  if (word.size() > longest_word || !nearest.empty()) return nearest;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > word.size() + largest_distance) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && distance < std::max(word.size(), candidate.size())) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest.empty() ? only_longer(word, candidates) : nearest;
}

}  // namespace qdot::api
