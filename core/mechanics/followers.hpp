#pragma once
// Parameters that are given by others, c = k*l^2/2: while k moves they follow it.

#include <map>
#include <string>
#include <vector>

#include "core/expr/calculus.hpp"

namespace qdot {

/// What a parameter is, by its name: an expression of others that do not follow themselves.
using Followers = std::map<std::string, std::string>;

/// Parameters in order, and expressions of `graph` that are their values by default.
struct DefaultValues {
  const Graph& graph;
  std::vector<std::string> names;
  const std::vector<Expression>& values;
};

/// Those that follow `moving`. `written`: what a request writes for symbols; the others have their defaults.
[[nodiscard]] Followers followers_of(const DefaultValues& defaults,
                                     const std::map<std::string, std::string>& written,
                                     const std::string& moving);

/// For expressions of `graph`, which may speak of these parameters. Texts that do not parse are left out.
[[nodiscard]] std::vector<Replacement> follower_replacements(Graph& graph, const Followers& followers,
                                                             const std::vector<std::string>& parameters);

}  // namespace qdot
