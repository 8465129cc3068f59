#include "core/expr/print/notation.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace qdot {
namespace {

/// The letters that LaTeX has a command for.
constexpr std::array<std::pair<std::string_view, std::string_view>, 37> greek{{
    {"alpha", "α"},      {"beta", "β"},  {"gamma", "γ"},  {"delta", "δ"},   {"epsilon", "ϵ"},
    {"varepsilon", "ε"}, {"zeta", "ζ"},  {"eta", "η"},    {"theta", "θ"},   {"vartheta", "ϑ"},
    {"iota", "ι"},       {"kappa", "κ"}, {"lambda", "λ"}, {"mu", "μ"},      {"nu", "ν"},
    {"xi", "ξ"},         {"pi", "π"},    {"rho", "ρ"},    {"sigma", "σ"},   {"tau", "τ"},
    {"upsilon", "υ"},    {"phi", "ϕ"},   {"varphi", "φ"}, {"chi", "χ"},     {"psi", "ψ"},
    {"omega", "ω"},      {"Gamma", "Γ"}, {"Delta", "Δ"},  {"Theta", "Θ"},   {"Lambda", "Λ"},
    {"Xi", "Ξ"},         {"Pi", "Π"},    {"Sigma", "Σ"},  {"Upsilon", "Υ"}, {"Phi", "Φ"},
    {"Psi", "Ψ"},        {"Omega", "Ω"},
}};

bool is_decimal(char c) { return c >= '0' && c <= '9'; }

/// Cuts `suffix` off the end of `name`, unless nothing else would be left.
bool take_suffix(std::string_view& name, std::string_view suffix) {
  if (name.size() <= suffix.size() || !name.ends_with(suffix)) return false;
  name.remove_suffix(suffix.size());
  return true;
}

std::size_t position(const std::vector<std::string>& names, std::string_view name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The role that a name's form gives it: what it is the derivative or momentum of, and the role.
std::pair<std::string_view, Role> derivative(std::string_view name, const Notation& notation) {
  std::string_view base = name;
  if (take_suffix(base, "_ddot")) return {base, Role::acceleration};
  if (take_suffix(base, "_dot")) return {base, Role::velocity};
  const bool momentum =
      name.starts_with("p_") && position(notation.coordinates, name.substr(2)) < notation.coordinates.size();
  if (momentum) return {name.substr(2), Role::velocity};
  return {name, Role::coordinate};
}

std::optional<std::string> given_latex(std::string_view name, const Notation& notation) {
  for (const auto& [given, latex] : notation.latex) {
    if (given == name && !latex.empty()) return latex;
  }
  return std::nullopt;
}

/// A base or an index without structure: \theta, m, 12, \mathrm{foot}.
std::string latex_word(std::string_view word) {
  if (!greek_letter(word).empty()) return "\\" + std::string(word);
  if (word.size() == 1 || std::all_of(word.begin(), word.end(), is_decimal)) return std::string(word);
  return "\\mathrm{" + std::string(word) + "}";
}

/// Whether TeX takes `latex` for one argument without braces: a character, or a command without arguments.
bool is_one_token(std::string_view latex) {
  if (latex.size() <= 1) return true;
  return latex[0] == '\\' && latex.find_first_of("{}_^ \\", 1) == std::string_view::npos;
}

std::string braced(const std::string& latex) { return is_one_token(latex) ? latex : "{" + latex + "}"; }

std::string latex_accent(std::string_view command, const std::string& latex) {
  const bool command_follows = latex.starts_with('\\') && is_one_token(latex);
  return "\\" + std::string(command) + (command_follows ? latex : "{" + latex + "}");
}

/// Length of what a dot goes over: theta_1 without its index; all of it when the index is inside of braces.
std::size_t letter_length(std::string_view latex) {
  const std::size_t index = std::min(latex.find('_'), latex.size());
  const std::string_view letter = latex.substr(0, index);
  const bool closed =
      std::count(letter.begin(), letter.end(), '{') == std::count(letter.begin(), letter.end(), '}');
  return closed ? index : latex.size();
}

std::string latex_index(const std::vector<std::string>& indices, const Notation& notation) {
  std::string joined;
  for (const std::string& index : indices) {
    if (!joined.empty()) joined += ",";
    joined += given_latex(index, notation).value_or(latex_word(index));
  }
  return joined.empty() ? "" : "_" + braced(joined);
}

std::string mathml_word(std::string_view word) {
  if (const auto letter = greek_letter(word); !letter.empty()) return "<mi>" + std::string(letter) + "</mi>";
  const bool number = std::all_of(word.begin(), word.end(), is_decimal);
  return number ? "<mn>" + std::string(word) + "</mn>" : "<mi>" + std::string(word) + "</mi>";
}

std::string mathml_accent(const std::string& base, std::string_view accent) {
  return "<mover accent=\"true\">" + base + "<mo>" + std::string(accent) + "</mo></mover>";
}

}  // namespace

Place place_of(std::string_view name, const Notation& notation) {
  if (name == "pi") return {Role::constant, 0};
  if (const std::size_t i = position(notation.parameters, name); i < notation.parameters.size()) {
    return {Role::parameter, i};
  }
  const auto [base, role] = derivative(name, notation);
  const std::size_t i = position(notation.coordinates, base);
  const bool undeclared = i == notation.coordinates.size();
  return {undeclared && role == Role::coordinate ? Role::other : role, i};
}

WrittenName written_name(std::string_view name) {
  WrittenName result;
  if (take_suffix(name, "_ddot")) {
    result.dots = 2;
  } else if (take_suffix(name, "_dot")) {
    result.dots = 1;
  }
  result.hat = take_suffix(name, "_hat");
  const std::size_t underscore = std::min(name.find('_'), name.size());
  std::string_view base = name.substr(0, underscore);
  std::size_t letters = base.size();
  while (letters > 1 && is_decimal(base[letters - 1])) --letters;
  result.base = base.substr(0, letters);
  if (letters < base.size()) result.indices.emplace_back(base.substr(letters));
  for (std::size_t at = underscore; at < name.size();) {
    const std::size_t end = std::min(name.find('_', at + 1), name.size());
    if (end > at + 1) result.indices.emplace_back(name.substr(at + 1, end - at - 1));
    at = end;
  }
  return result;
}

std::string_view greek_letter(std::string_view name) {
  const auto found =
      std::find_if(greek.begin(), greek.end(), [&](const auto& entry) { return entry.first == name; });
  return found == greek.end() ? std::string_view{} : found->second;
}

std::string latex_name(std::string_view name, const Notation& notation) {
  if (const auto given = given_latex(name, notation)) return *given;
  constexpr std::array<std::string_view, 3> dots{"", "dot", "ddot"};
  const WrittenName parts = written_name(name);
  std::string_view undotted = name;
  if (parts.dots > 0) undotted.remove_suffix(dots[parts.dots].size() + 1);
  if (const auto given = given_latex(undotted, notation); given && parts.dots > 0) {
    const std::size_t letter = letter_length(*given);
    return latex_accent(dots[parts.dots], given->substr(0, letter)) + given->substr(letter);
  }
  std::string latex = latex_word(parts.base);
  if (parts.hat) latex = latex_accent("hat", latex);
  if (parts.dots > 0) latex = latex_accent(dots[parts.dots], latex);
  return latex + latex_index(parts.indices, notation);
}

std::string mathml_name(std::string_view name) {
  const WrittenName parts = written_name(name);
  std::string element = mathml_word(parts.base);
  if (parts.hat) element = mathml_accent(element, "^");
  if (parts.dots > 0) element = mathml_accent(element, parts.dots == 1 ? "˙" : "¨");
  if (parts.indices.empty()) return element;
  std::string indices;
  for (const std::string& index : parts.indices) {
    if (!indices.empty()) indices += "<mo>,</mo>";
    indices += mathml_word(index);
  }
  if (parts.indices.size() > 1) indices = "<mrow>" + indices + "</mrow>";
  return "<msub>" + element + indices + "</msub>";
}

}  // namespace qdot
