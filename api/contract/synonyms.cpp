#include "api/contract/synonyms.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr std::string_view velocity = "_dot";
constexpr auto marks_of_the_start =
    std::to_array<std::string_view>({"initial", "init", "start", "zero", "0"});
constexpr auto primes = std::to_array<std::string_view>({"'", "’", "′", "\u0307"});
constexpr auto words_of_friction = std::to_array<std::string_view>(
    {"damping", "friction", "drag", "viscosity", "dampingcoefficient", "dampingratio", "dissipation"});

std::vector<std::string> names_of(std::span<const Symbol> symbols) {
  std::vector<std::string> names;
  for (const Symbol& symbol : symbols) names.push_back(symbol.name);
  return names;
}

/// The symbol of a name that also says "at the start".
std::string without_mark_of_the_start(const std::string& word, std::span<const std::string> names) {
  for (const std::string_view mark : marks_of_the_start) {
    std::string_view rest = word;
    if (rest.ends_with(mark)) {
      rest.remove_suffix(mark.size());
    } else if (rest.starts_with(mark)) {
      rest.remove_prefix(mark.size());
    } else {
      continue;
    }
    if (const std::string found = same_letters(rest, names); !found.empty()) return found;
  }
  return {};
}

/// What others write for the velocity of the coordinate q.
bool says_velocity_of(std::string_view q, std::string_view word) {
  const std::string name = lower_case(letters_of(q));
  for (const char* before : {"d", "v", "w", "dot", "omega", "vel"})
    if (word == before + name) return true;
  for (const char* after : {"d", "p", "dt", "dot", "prime", "rate", "velocity", "speed", "vel"})
    if (word == name + after) return true;
  return word == "d" + name + "dt";
}

std::string velocity_of_a_coordinate(const std::string& word, std::span<const std::string> names) {
  for (const std::string& name : names) {
    if (name.ends_with(velocity) && says_velocity_of(name.substr(0, name.size() - velocity.size()), word))
      return name;
  }
  return {};
}

/// The first symbol in the unit that the word speaks of; of lengths a second, a velocity.
std::string velocity_in_words(std::string_view word, std::span<const Symbol> symbols) {
  if (word.ends_with('0')) word.remove_suffix(1);
  const bool turns = word == "omega" || word == "w" || word == "angularvelocity" || word == "angularspeed";
  if (!turns && word != "v" && word != "velocity" && word != "speed") return {};
  const std::string_view unit = turns ? "rad/s" : "m/s";
  const auto found = std::ranges::find_if(
      symbols, [&](const Symbol& s) { return (turns || s.name.ends_with(velocity)) && s.unit == unit; });
  return found == symbols.end() ? "" : found->name;
}

/// Are these forms of one word? "gravity" and "gravitational" are.
bool related(std::string_view a, std::string_view b) {
  constexpr std::size_t stem = 6;
  return a == b || (a.size() > stem && b.size() > stem && a.substr(0, stem) == b.substr(0, stem));
}

/// How soon the word comes in a meaning: 0 is the first word. What comes after "of", "from" and their like
/// speaks of other things.
std::size_t position_in(std::string_view meaning, std::string_view word) {
  for (std::size_t position = 0; !meaning.empty(); ++position) {
    const std::string_view next = meaning.substr(0, meaning.find(' '));
    if (next == "of" || next == "from" || next == "at" || next == "between" || next.ends_with(',')) break;
    if (related(lower_case(next), word)) return position;
    meaning.remove_prefix(std::min(next.size() + 1, meaning.size()));
  }
  return std::string_view::npos;
}

std::string symbol_with_meaning(std::string_view word, std::span<const Symbol> symbols) {
  constexpr std::size_t shortest = 4;
  std::string found;
  std::size_t least = std::string_view::npos;
  if (word.size() < shortest) return found;
  for (const Symbol& symbol : symbols) {
    const std::size_t position = position_in(symbol.meaning, word);
    if (position >= least) continue;
    least = position;
    found = symbol.name;
  }
  return found;
}

}  // namespace

std::string meant_symbol(std::string_view name, std::span<const Symbol> symbols) {
  if (name.size() > limits::name_bytes) return {};
  const std::string word = lower_case(letters_of(name));
  const std::vector<std::string> names = names_of(symbols);
  std::string found = without_mark_of_the_start(letters_of(name), names);
  if (found.empty()) found = velocity_of_a_coordinate(word, names);
  if (found.empty()) found = velocity_in_words(word, symbols);
  if (found.empty()) found = symbol_with_meaning(word, symbols);
  return found;
}

std::string with_dot_for_prime(std::string_view name) {
  for (const std::string_view prime : primes)
    if (name.ends_with(prime)) return std::string(name.substr(0, name.size() - prime.size())) + "_dot";
  return std::string(name);
}

bool names_friction(std::string_view name) {
  return name.size() <= limits::name_bytes &&
         std::ranges::find(words_of_friction, lower_case(letters_of(name))) != words_of_friction.end();
}

}  // namespace qdot::api
