#include "api/answers/check/spoken_words.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr std::array stabilities{std::string_view("stable"), std::string_view("unstable"),
                                 std::string_view("neutral")};
constexpr std::array motions{std::string_view("libration"), std::string_view("rotation"),
                             std::string_view("separatrix"), std::string_view("equilibrium"),
                             std::string_view("unbounded")};
constexpr std::array mode_kinds{std::string_view("oscillation"), std::string_view("rigid"),
                                std::string_view("growth"), std::string_view("decay")};
constexpr std::array bifurcation_kinds{
    std::string_view("pitchfork"), std::string_view("saddle node"),     std::string_view("transcritical"),
    std::string_view("fold"),      std::string_view("period doubling"), std::string_view("neimark sacker"),
    std::string_view("hopf"),      std::string_view("flutter")};
constexpr std::array gait_kinds{std::string_view("short"), std::string_view("long")};

/// Other words for the same.
constexpr auto same =
    std::to_array<std::pair<std::string_view, std::string_view>>({{"instable", "unstable"},
                                                                  {"oscillatory", "oscillation"},
                                                                  {"librating", "libration"},
                                                                  {"rotating", "rotation"}});

/// Words that say nothing of which one it is.
constexpr std::array fillers{"it",   "is",          "its",      "a",        "an",    "the",
                             "this", "that",        "point",    "position", "state", "motion",
                             "mode", "equilibrium", "solution", "body",     "gait",  "bifurcation"};

std::string_view meant(std::string_view word) {
  const auto found = std::ranges::find(same, word, &std::pair<std::string_view, std::string_view>::first);
  return found == same.end() ? word : found->second;
}

/// The choice of one word or two at the beginning of `rest`, which is taken from it.
std::optional<std::string_view> take_choice(std::string_view& rest,
                                            std::span<const std::string_view> choices) {
  for (const std::string_view choice : choices) {
    const bool begins =
        rest.starts_with(choice) && (rest.size() == choice.size() || rest[choice.size()] == ' ');
    if (!begins) continue;
    rest.remove_prefix(choice.size());
    return choice;
  }
  const std::size_t end = std::min(rest.find(' '), rest.size());
  const std::string_view word = meant(rest.substr(0, end));
  const auto found = std::ranges::find(choices, word);
  if (found == choices.end()) return std::nullopt;
  rest.remove_prefix(end);
  return *found;
}

}  // namespace

std::string as_words(std::string_view text) {
  std::string words = lower_case(trimmed(text));
  std::ranges::replace_if(
      words, [](char c) { return c == '_' || c == '-'; }, ' ');
  if (words.ends_with('.') || words.ends_with('!')) words.pop_back();
  return words;
}

std::span<const std::string_view> choices_with(std::string_view word) {
  for (const std::span<const std::string_view> all :
       {std::span<const std::string_view>(stabilities), std::span<const std::string_view>(motions),
        std::span<const std::string_view>(mode_kinds), std::span<const std::string_view>(bifurcation_kinds),
        std::span<const std::string_view>(gait_kinds)}) {
    if (std::ranges::find(all, word) != all.end()) return all;
  }
  return {};
}

std::optional<std::string_view> spoken_choice(std::string_view text,
                                              std::span<const std::string_view> choices) {
  const std::string words = as_words(text);
  std::optional<std::string_view> spoken;
  for (std::string_view rest = trimmed(words); !rest.empty(); rest = trimmed(rest)) {
    if (const auto choice = take_choice(rest, choices)) {
      if (spoken && *spoken != *choice) return std::nullopt;
      spoken = choice;
      continue;
    }
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (std::ranges::find(fillers, rest.substr(0, end)) == fillers.end()) return std::nullopt;
    rest.remove_prefix(end);
  }
  return spoken;
}

}  // namespace qdot::api
