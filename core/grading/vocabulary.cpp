#include "core/grading/vocabulary.hpp"

#include <algorithm>
#include <array>

namespace qdot {
namespace {

std::string name_of(const Expression& symbol) { return std::get<Symbol>(symbol.node()).name; }

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

/// "omega0" as "omega_0", with which LaTeX and people write the index.
std::string with_index_apart(const std::string& name) {
  const auto digits = std::ranges::find_if(name, is_decimal_digit);
  if (digits == name.begin() || digits == name.end() || *(digits - 1) == '_') return name;
  if (!std::all_of(digits, name.end(), is_decimal_digit)) return name;
  return std::string(name.begin(), digits) + "_" + std::string(digits, name.end());
}

constexpr std::array rate_endings{"_dot", "dot", "_d", "d", "_t"};
constexpr std::array second_rate_endings{"_ddot",  "ddot",        "_dd",       "dd",         "_dot_dot",
                                         "dotdot", "_double_dot", "doubledot", "_doubledot", "_tt"};

}  // namespace

Vocabulary::Vocabulary(const Symbols& symbols, std::span<const Expression> more) : time_(symbols.t) {
  rates_ = symbols.rates();
  accelerations_ = symbols.coordinates.second_rate;
  const auto add_declared = [&](const Expression& e) {
    names_.push_back(name_of(e));
    words_.emplace(name_of(e), e);
  };
  for (const Expression& e : symbols.coordinates.value) add_declared(e);
  for (const Expression& e : symbols.parameters) add_declared(e);
  for (const Expression& e : symbols.inputs.value) add_declared(e);
  for (const Expression& e : more) add_declared(e);
  add_declared(symbols.t);
  words_.emplace("pi", symbols.t.graph().symbol("pi"));
  // Other spellings come after all names, which they never take away.
  for (const std::string& name : std::vector(names_)) add_spellings(name, words_.at(name));
  for (const Symbols::Varying* varying : {&symbols.coordinates, &symbols.inputs}) {
    for (std::size_t i = 0; i < varying->value.size(); ++i) {
      add_rates(name_of(varying->value[i]), varying->rate[i], varying->second_rate[i]);
      add_rates(with_index_apart(name_of(varying->value[i])), varying->rate[i], varying->second_rate[i]);
    }
  }
}

void Vocabulary::add_spellings(const std::string& name, const Expression& e) {
  words_.emplace(with_index_apart(name), e);
  std::string joined = name;  // p_theta and ptheta
  std::erase(joined, '_');
  words_.emplace(joined, e);
}

void Vocabulary::add_rates(const std::string& name, const Expression& rate, const Expression& second_rate) {
  for (const char* ending : rate_endings) words_.emplace(name + ending, rate);
  for (const char* ending : second_rate_endings) words_.emplace(name + ending, second_rate);
  words_.emplace("dd" + name, second_rate);
}

bool Vocabulary::add(const std::string& word, const std::string& meaning) {
  const auto found = words_.find(meaning);
  if (found == words_.end()) return false;
  const Expression e = found->second;
  words_.insert_or_assign(word, e);
  added_.push_back(word);
  const auto rate_of = [&](const Expression& x) {
    const auto pair = std::ranges::find(rates_, x, [](const Replacement& r) { return r.first; });
    return pair == rates_.end() || x == time_ ? std::nullopt : std::optional(pair->second);
  };
  const auto rate = rate_of(e);
  const auto second = rate ? rate_of(*rate) : std::nullopt;
  if (second) {
    add_rates(word, *rate, *second);
  } else if (rate) {
    for (const char* ending : rate_endings) words_.emplace(word + ending, *rate);
  }
  return true;
}

std::optional<Expression> Vocabulary::find(std::string_view word) const {
  const auto found = words_.find(word);
  return found == words_.end() ? std::nullopt : std::optional(found->second);
}

bool Vocabulary::is_certain(std::string_view word) const {
  if (word.find('_') != std::string_view::npos) return true;
  return std::ranges::find(names_, word) != names_.end() || std::ranges::find(added_, word) != added_.end();
}

void Vocabulary::add_rate(const Expression& symbol, const Expression& rate) {
  rates_.emplace_back(symbol, rate);
  const std::string name = name_of(symbol);
  words_.emplace(name + "_dot", rate);
}

bool Vocabulary::has_accelerations(const Expression& e) const { return depends_on(e, accelerations_); }

bool Vocabulary::varies(const Expression& e) const {
  return std::ranges::any_of(rates_, [&](const Replacement& r) { return depends_on(e, r.first); });
}

}  // namespace qdot
