#include "core/mechanics/negative_inertia.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/expr/polynomial.hpp"
#include "core/mechanics/equations_of_motion.hpp"
#include "core/numerics/interval.hpp"

namespace qdot {
namespace {

/// Where expressions lie while the parameters and the coordinates are in their domains.
class Ranges {
 public:
  Ranges(const Scene& scene, const Symbols& symbols) {
    for (std::size_t i = 0; i < scene.parameters.size(); ++i)
      add(symbols.parameters[i], scene.parameters[i].domain);
    for (std::size_t i = 0; i < scene.coordinates.size(); ++i)
      add(symbols.coordinates.value[i], scene.coordinates[i].domain);
  }

  Interval of(const Expression& e) {
    const NodeId root = e.id();
    for (const NodeId id : reachable(e.graph(), std::array{root}))
      if (!known_.contains(id)) known_.emplace(id, of_node(e.graph().node(id)));
    return known_.at(root);
  }

  /// Whether it is a symbol that is never zero, nor below.
  [[nodiscard]] bool is_above_zero(NodeId symbol) const { return above_zero_.contains(symbol); }

 private:
  void add(const Expression& symbol, const Domain& domain) {
    known_.emplace(symbol.id(), Interval(domain.lower, domain.upper));
    if (domain.lower > 0 || (domain.lower == 0 && domain.lower_open)) above_zero_.insert(symbol.id());
  }

  [[nodiscard]] Interval of_node(const Node& node) const {
    return std::visit(
        overloaded{[](const Literal& l) { return Interval::literal(l.value.rounded()); },
                   [](const Symbol&) { return Interval::whole(); },
                   [&](const Sum& sum) {
                     Interval total(0);
                     for (const NodeId id : sum.terms) total = total + known_.at(id);
                     return total;
                   },
                   [&](const Product& product) {
                     Interval all = Interval::literal(product.coefficient.rounded());
                     for (const NodeId id : product.factors) all = all * known_.at(id);
                     return all;
                   },
                   [&](const Power& power) {
                     return qdot::power(known_.at(power.base), Interval::literal(power.exponent.rounded()));
                   },
                   [&](const Call& call) { return evaluate(call.function, known_.at(call.argument)); }},
        node);
  }

  std::map<NodeId, Interval> known_;
  std::set<NodeId> above_zero_;
};

bool is_negative(Ranges& ranges, const Expression& e) { return !e.is_zero() && ranges.of(e).upper <= 0; }

/// Whether a coordinate that moves alone has no kinetic energy above zero.
bool has_negative_coordinate(Ranges& ranges, const Matrix& mass_matrix) {
  for (std::size_t i = 0; i < mass_matrix.size(); ++i)
    if (is_negative(ranges, mass_matrix[i][i])) return true;
  return false;
}

bool has_negative_moment(Ranges& ranges, const ParsedBody& body) {
  return std::ranges::any_of(body.spins, [&](const ParsedSpin& s) { return is_negative(ranges, s.inertia); });
}

/// Below zero even where it comes as near to zero as parameters allow: -I1 for I1 > 0.
bool is_never_zero(Ranges& ranges, const Expression& negative) {
  const Polynomial terms = multiplied_out(negative);
  const auto is_below = [&](const auto& term) {
    return ranges.of(to_expression(negative.graph(), term.first)).lower >= 0 && term.second.is_negative();
  };
  const auto is_strict = [&](const auto& term) {
    return std::ranges::all_of(term.first, [&](const Atom& atom) { return ranges.is_above_zero(atom.base); });
  };
  return std::ranges::all_of(terms, is_below) && std::ranges::any_of(terms, is_strict);
}

/// Whether one is larger than the sum of the other two, whatever the parameters are (moments.hpp).
bool has_impossible_moments(Ranges& ranges, const ParsedBody& body) {
  if (body.turns.empty() || body.spins.size() != 3) return false;
  const Expression sum = body.spins[0].inertia + body.spins[1].inertia + body.spins[2].inertia;
  return std::ranges::any_of(body.spins, [&](const ParsedSpin& spin) {
    const Expression e = sum - Number(2) * spin.inertia;
    return ranges.of(e).upper < 0 || is_never_zero(ranges, e);
  });
}

}  // namespace

std::vector<Diagnostic> negative_inertia(const Scene& scene, const ParsedScene& parsed,
                                         const Lagrangian& lagrangian) {
  Ranges ranges(scene, parsed.symbols);
  std::vector<Diagnostic> moments, masses;
  for (std::size_t i = 0; i < parsed.bodies.size(); ++i) {
    const ParsedBody& body = parsed.bodies[i];
    const std::string place = "/bodies/" + std::to_string(i);
    if (is_negative(ranges, body.mass)) {
      masses.push_back(
          {place + "/mass", "domain",
           "A mass must be above zero. Only that of a hole is below zero, in a body that outweighs it."});
    } else if (has_negative_moment(ranges, body)) {
      moments.push_back({place, "domain", "A moment of inertia is not below zero."});
    } else if (has_impossible_moments(ranges, body)) {
      moments.push_back({place, "domain", "No principal moment is larger than the sum of the other two."});
    }
  }
  if (!moments.empty() || masses.empty() || !parsed.constraints.empty()) return moments;
  return has_negative_coordinate(ranges, mass_matrix(lagrangian)) ? masses : moments;
}

}  // namespace qdot
