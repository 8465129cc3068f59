#include "core/mechanics/followers.hpp"

#include <algorithm>

#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"

namespace qdot {
namespace {

/// What each parameter is, where it is an expression.
std::vector<Replacement> given_by_others(const DefaultValues& defaults, Graph& graph,
                                         const std::map<std::string, std::string>& written) {
  const std::vector<std::string>& names = defaults.names;
  std::vector<Replacement> result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto text = written.find(names[i]);
    const auto value = text == written.end() ? std::optional(graph.adopt(defaults.values[i]))
                                             : parse_all(text->second, graph, names).expression;
    if (value && value->number() == nullptr) result.emplace_back(graph.symbol(names[i]), *value);
  }
  return result;
}

/// Until no value speaks of a symbol that has one.
void resolve(std::vector<Replacement>& replacements) {
  for (std::size_t round = 0; round < replacements.size(); ++round) {
    for (auto& [symbol, value] : replacements) value = substitute(value, replacements);
  }
}

}  // namespace

Followers followers_of(const DefaultValues& defaults, const std::map<std::string, std::string>& written,
                       const std::string& moving) {
  Graph graph(defaults.graph);
  const Expression p = graph.symbol(moving);
  std::vector<Replacement> all = given_by_others(defaults, graph, written);
  std::erase_if(all, [&](const Replacement& r) { return r.first == p; });
  resolve(all);
  Followers result;
  for (const auto& [symbol, value] : all) {
    if (depends_on(value, p)) result[print(symbol, Form::text)] = print(value, Form::text);
  }
  return result;
}

std::vector<Replacement> follower_replacements(Graph& graph, const Followers& followers,
                                               const std::vector<std::string>& parameters) {
  std::vector<Replacement> result;
  for (const auto& [name, text] : followers) {
    if (const auto value = parse_all(text, graph, parameters).expression)
      result.emplace_back(graph.symbol(name), *value);
  }
  return result;
}

}  // namespace qdot
