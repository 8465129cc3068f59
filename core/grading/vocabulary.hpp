#pragma once
// The words a submission may use: the symbols of a scene, in the spellings that people have for them, and the
// words that a teacher allows beside.

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/grading/plain_notation.hpp"
#include "core/mechanics/symbols.hpp"

namespace qdot {

/// A submission's own word for a symbol: {"w", "Omega"}, {"omega", "theta_dot"}.
using Naming = std::pair<std::string, std::string>;

class Vocabulary {
 public:
  /// `more`: symbols that the scene does not declare, such as momenta.
  Vocabulary(const Symbols& symbols, std::span<const Expression> more = {});

  /// False where `meaning` is no word here. A word for a coordinate stands for its rates, too.
  [[nodiscard]] bool add(const std::string& word, const std::string& meaning);

  /// What a symbol that the scene does not declare, such as a momentum, has for its rate.
  void add_rate(const Expression& symbol, const Expression& rate);

  /// An angle is no length: "sin theta/l" is (sin theta)/l then.
  void mark_angle(const Expression& symbol) { angles_.push_back(symbol); }
  [[nodiscard]] bool is_angle(const Expression& e) const {
    return std::ranges::find(angles_, e) != angles_.end();
  }

  [[nodiscard]] std::optional<Expression> find(std::string_view word) const;
  /// Whether the word is a symbol as the scene or the teacher names it, and no other spelling of one.
  [[nodiscard]] bool is_certain(std::string_view word) const;
  /// (x, x') for everything that changes in time.
  [[nodiscard]] const std::vector<Replacement>& rates() const { return rates_; }
  /// The scene's own names, for messages.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] bool varies(const Expression& e) const;
  /// Of which there is no rate here.
  [[nodiscard]] bool has_accelerations(const Expression& e) const;
  [[nodiscard]] const Expression& time() const { return time_; }

 private:
  void add_spellings(const std::string& name, const Expression& e);
  void add_rates(const std::string& name, const Expression& rate, const Expression& second_rate);

  std::map<std::string, Expression, std::less<>> words_;
  std::vector<Replacement> rates_;
  std::vector<std::string> names_, added_;
  std::vector<Expression> angles_, accelerations_;
  Expression time_;
};

/// The ways to cut a word into known words, up to two: "mgl" is m g l. `knows` says which words there are.
template <class Knows>
std::vector<std::vector<std::string_view>> cuts(std::string_view word, const Knows& knows) {
  constexpr std::size_t longest = 48;
  std::vector<std::vector<std::string_view>> found;
  if (word.size() > longest) return found;
  // ways[i]: of the letters from i on, no more than two.
  std::vector<std::vector<std::vector<std::string_view>>> ways(word.size() + 1);
  ways[word.size()] = {{}};
  for (std::size_t first = word.size(); first-- > 0;) {
    for (std::size_t end = first + 1; end <= word.size(); ++end) {
      const std::string_view head = word.substr(first, end - first);
      if (ways[end].empty() || !knows(head)) continue;
      for (const auto& rest : ways[end]) {
        if (ways[first].size() == 2) break;
        ways[first].push_back({head});
        ways[first].back().insert(ways[first].back().end(), rest.begin(), rest.end());
      }
    }
  }
  return ways[0];
}

}  // namespace qdot
