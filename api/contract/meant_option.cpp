#include "api/contract/meant_option.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "api/json/suggest.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

/// Other programs' words, and the words of ours that may be meant.
constexpr auto foreign_choices = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"tex", "latex"},
    {"python", "sympy"},
    {"py", "sympy"},
    {"html", "mathml"},
    {"plain", "text"},
    {"ascii", "text"},
    {"quad", "extended"},
    {"high", "accurate"},
    {"rk45", "erk"},
    {"rk4", "erk"},
    {"dop853", "erk"},
    {"lsoda", "auto"},
    {"radau", "bdf"},
    {"symplectic", "gauss"},
    {"e", "energy"},
    {"h", "energy"},
    {"total_energy", "energy"},
    {"kinetic", "T"},
    {"kinetic_energy", "T"},
    {"potential", "V"},
    {"potential_energy", "V"},
    {"momentum", "momenta"},
    {"xy", "positions"},
    {"points", "positions"},
    {"tension", "validity"},
    {"tsv", "csv"},
    {"excel", "csv"},
    {"jsonl", "ndjson"},
    {"hoop", "ring"},
    {"disc", "disk"},
    {"wheel", "disk"},
    {"coin", "disk"},
    {"ball", "sphere"},
    {"bar", "rod"},
    {"beam", "rod"},
    {"stick", "rod"},
    {"plate", "box"},
    {"block", "box"},
    {"cube", "box"},
    {"cuboid", "box"},
    {"point", "particle"},
    {"point_mass", "particle"},
    {"mass", "particle"},
    {"bead", "particle"},
    {"bob", "particle"},
});

}  // namespace

std::string meant_option(const std::string& word, const std::vector<std::string>& options) {
  const auto offered = [&](std::string_view option) {
    return std::ranges::find(options, option) != options.end() ? std::string(option) : std::string();
  };
  if (word.ends_with("_ddot")) return offered("accelerations");
  if (word.starts_with("p_")) return offered("momenta");
  const std::string plain = lower_case(word);
  for (const auto& [foreign, ours] : foreign_choices) {
    if (foreign == plain && !offered(ours).empty()) return std::string(ours);
  }
  return closest(word, options);
}

std::string with_commas(std::string_view words, const std::vector<std::string>& options) {
  std::string list;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find_first_of(" ;|+"), words.size());
    const std::string word(words.substr(0, end));
    words.remove_prefix(std::min(end + 1, words.size()));
    if (word.empty()) continue;
    if (std::ranges::find(options, word) == options.end()) return {};
    list += (list.empty() ? "" : ",") + word;
  }
  return list;
}

}  // namespace qdot::api
