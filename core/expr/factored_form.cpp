#include "core/expr/factored_form.hpp"

#include <algorithm>

#include "core/expr/bracket_memory.hpp"

namespace qdot {
namespace {

constexpr std::size_t worthwhile_saving = 3;
/// Up to so many terms alternatives are compared; beyond, the first choice is taken.
constexpr std::size_t most_compared = 24;
/// Brackets within brackets in which alternatives are compared: each multiplies the work by two to four.
constexpr int compared_levels = 4;

/// A level of brackets, and in how many levels from there on alternatives are compared.
struct FactorLevel {
  Graph& graph;
  int depth{compared_levels};
  [[nodiscard]] FactorLevel inside() const { return {graph, std::max(depth - 1, 0)}; }
};

Expression factored_form(FactorLevel level, const Polynomial& polynomial);
Expression primitive(FactorLevel level, const Polynomial& polynomial);

Number size_of(const Number& number) { return number.is_negative() ? -number : number; }

/// The coefficient of which all others are whole multiples, if there is one.
std::optional<Number> common_coefficient(const Polynomial& polynomial) {
  Number least = size_of(polynomial.begin()->second);
  for (const auto& [monomial, coefficient] : polynomial) least = std::min(least, size_of(coefficient));
  for (const auto& [monomial, coefficient] : polynomial) {
    if (!(coefficient / least).is_integer()) return std::nullopt;
  }
  return least;
}

bool all_negative(const Polynomial& polynomial) {
  return std::all_of(polynomial.begin(), polynomial.end(),
                     [](const auto& term) { return term.second.is_negative(); });
}

/// Numbers worth taking out: the commonest and the least coefficient, one, and what divides them all.
std::vector<Number> numeric_factors(const Polynomial& polynomial) {
  if (polynomial.size() > most_compared) return {common_coefficient(polynomial).value_or(Number(1))};
  std::vector<Number> sizes;
  Number divisor = size_of(polynomial.begin()->second);
  for (const auto& [monomial, coefficient] : polynomial) {
    if (!divisor.is_one() || !coefficient.is_integer()) divisor = gcd(divisor, coefficient);
    sizes.push_back(size_of(coefficient));
  }
  std::ranges::sort(sizes, std::less<>());
  auto commonest = sizes.begin();
  std::ptrdiff_t most = 0;
  for (auto at = sizes.begin(); at != sizes.end();) {
    const auto end = std::find_if(at, sizes.end(), [&](const Number& size) { return !(size == *at); });
    if (end - at > most) {
      most = end - at;
      commonest = at;
    }
    at = end;
  }
  std::vector<Number> factors;
  for (const Number& number : {*commonest, sizes.front(), Number(1), divisor}) {
    if (std::find(factors.begin(), factors.end(), number) == factors.end()) factors.push_back(number);
  }
  return factors;
}

std::vector<Number> numbers_in_front(FactorLevel level, const Polynomial& polynomial) {
  if (level.depth > 0) return numeric_factors(polynomial);
  return {common_coefficient(polynomial).value_or(Number(1))};
}

/// A power of one symbol or bracket that many terms share, and how many.
struct Shared {
  Atom atom{};
  std::size_t terms{};
};

/// Those that most terms share, at most two: the first and the last of equals.
std::vector<Shared> most_shared(const Polynomial& polynomial) {
  std::map<NodeId, Shared> shared;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      if (atom.p < 0) continue;
      Shared& entry = shared.try_emplace(atom.base, Shared{atom, 0}).first->second;
      ++entry.terms;
      if (atom.p * entry.atom.q < entry.atom.p * atom.q) entry.atom = atom;
    }
  }
  std::vector<Shared> best;
  for (const auto& [base, entry] : shared) {
    if (entry.terms < 2 || (!best.empty() && entry.terms < best[0].terms)) continue;
    if (!best.empty() && entry.terms > best[0].terms) best.clear();
    if (best.size() == 2) best.pop_back();
    best.push_back(entry);
  }
  return best;
}

/// The bracket below that most terms share, in its least power.
std::optional<Atom> most_shared_below(const Graph& graph, const Polynomial& polynomial) {
  std::map<NodeId, Shared> shared;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      if (atom.p > 0 || !std::holds_alternative<Sum>(graph.node(atom.base))) continue;
      Shared& entry = shared.try_emplace(atom.base, Shared{atom, 0}).first->second;
      ++entry.terms;
      if (atom.p * entry.atom.q > entry.atom.p * atom.q) entry.atom = atom;
    }
  }
  const auto most =
      std::ranges::max_element(shared, {}, [](const auto& entry) { return entry.second.terms; });
  if (most == shared.end() || most->second.terms < 2) return std::nullopt;
  return most->second.atom;
}

/// Of a sum with a minus before each of its terms: its opposite.
std::optional<Expression> without_minus(const Expression& sum) {
  const auto* own = std::get_if<Sum>(&sum.node());
  if (own == nullptr) return std::nullopt;
  std::vector<Expression> terms;
  for (const NodeId id : own->terms) {
    const Expression term(sum.graph(), id);
    if (!split_coefficient(term).coefficient.is_negative()) return std::nullopt;
    terms.push_back(-term);
  }
  return sum.graph().sum(terms);
}

/// polynomial = common (rest), with the number in front that makes the whole shortest.
Expression with_common_factor(FactorLevel level, const Polynomial& polynomial, const Monomial& common) {
  const Number sign(all_negative(polynomial) ? -1 : 1);
  const Polynomial rest = scaled(polynomial, inverse(common), sign);
  const Expression front = to_expression(level.graph, common);
  Expression best;
  std::size_t least = static_cast<std::size_t>(-1);
  for (const Number& number : numbers_in_front(level, rest)) {
    const Expression bracket = number.is_one()
                                   ? primitive(level.inside(), rest)
                                   : primitive(level.inside(), scaled(rest, {}, Number(1) / number));
    const auto opposite = without_minus(bracket);
    const Expression candidate =
        (opposite ? -sign * number : sign * number) * front * opposite.value_or(bracket);
    const std::size_t cost = written_length(candidate);
    if (cost < least) {
      least = cost;
      best = candidate;
    }
  }
  return best;
}

/// The terms that have the atom, or one of its powers of the same sign, and the others.
std::pair<Polynomial, Polynomial> split_by(const Polynomial& polynomial, const Atom& atom) {
  std::pair<Polynomial, Polynomial> parts;
  for (const auto& [monomial, coefficient] : polynomial) {
    const bool has = std::any_of(monomial.begin(), monomial.end(), [&](const Atom& a) {
      return a.base == atom.base && (a.p > 0) == (atom.p > 0);
    });
    Polynomial& part = has ? parts.first : parts.second;
    part.emplace_hint(part.end(), monomial, coefficient);
  }
  return parts;
}

/// The terms that share the atom in a bracket of their own, the others beside it.
Expression grouped_by(FactorLevel level, const Polynomial& polynomial, const Atom& atom) {
  const auto [group, others] = split_by(polynomial, atom);
  if (others.empty()) return with_common_factor(level, polynomial, Monomial{atom});
  const Monomial front = common_monomial(group);
  const Polynomial bracket = scaled(group, inverse(front), 1);
  if (const auto quotient = exact_quotient(others, bracket)) {
    Polynomial cofactor = *quotient;
    add(cofactor, front, 1);
    // (a + b) (l - r) rather than (-a - b) (r - l)
    const Number sign(all_negative(cofactor) || all_negative(bracket) ? -1 : 1);
    return factored_form(level, scaled(cofactor, {}, sign)) * factored_form(level, scaled(bracket, {}, sign));
  }
  return with_common_factor(level, group, front) + factored_form(level, others);
}

Expression grouped_by_factors(FactorLevel level, const Polynomial& polynomial) {
  const std::vector<Shared> shared = most_shared(polynomial);
  if (shared.empty()) return to_expression(level.graph, polynomial);
  const bool one = shared.size() == 1 || polynomial.size() > most_compared || level.depth == 0;
  if (one) return grouped_by(level, polynomial, shared.back().atom);  // parameters come last
  const Expression last = grouped_by(level.inside(), polynomial, shared.back().atom);
  const Expression first = grouped_by(level.inside(), polynomial, shared.front().atom);
  return written_length(first) < written_length(last) ? first : last;
}

/// The shortest of the groupings.
Expression best_grouped(FactorLevel level, const Polynomial& polynomial) {
  const Expression best = grouped_by_factors(level, polynomial);
  if (level.depth == 0 || polynomial.size() > most_compared) return best;
  const auto below = most_shared_below(level.graph, polynomial);
  if (!below) return best;
  const Expression other = grouped_by(level.inside(), polynomial, *below);
  return written_length(other) < written_length(best) ? other : best;
}

Expression squared_or_grouped(FactorLevel level, const Polynomial& polynomial) {
  if (polynomial.size() > 2) {
    if (const auto root = exact_root(polynomial)) return pow(factored_form(level, *root), Number(2));
    if (const auto root = exact_root(scaled(polynomial, {}, -1)))
      return -pow(factored_form(level, *root), Number(2));
  }
  return best_grouped(level, polynomial);
}

/// The polynomial without its common monomial and number.
Expression primitive(FactorLevel level, const Polynomial& polynomial) {
  if (polynomial.size() > most_compared) return squared_or_grouped(level, polynomial);
  BracketMemory& memory = level.graph.brackets();
  const BracketMemory::Key key = BracketMemory::key(level.depth, polynomial);
  if (const auto known = memory.form_of(key)) return {level.graph, *known};
  const Expression form = squared_or_grouped(level, polynomial);
  memory.keep(key, form.id());
  return form;
}

Expression factored_form(FactorLevel level, const Polynomial& polynomial) {
  if (polynomial.size() < 2) return to_expression(level.graph, polynomial);
  const Monomial common = common_monomial(polynomial);
  const bool worthwhile = common.size() * (polynomial.size() - 1) >= worthwhile_saving;
  if (common.empty() || worthwhile || common_coefficient(polynomial)) {
    return with_common_factor(level, polynomial, common);
  }
  return to_expression(level.graph, polynomial);
}

}  // namespace

Expression factored_form(Graph& graph, const Polynomial& polynomial) {
  return factored_form(FactorLevel{graph}, polynomial);
}

Expression collected_form(Graph& graph, const Polynomial& polynomial, std::span<const Expression> symbols) {
  const auto is_chosen = [&](const Atom& atom) {
    return std::any_of(symbols.begin(), symbols.end(),
                       [&](const Expression& s) { return s.id() == atom.base; });
  };
  if (polynomial.empty()) return graph.number(0);
  Monomial common = common_monomial(polynomial);
  std::erase_if(common, is_chosen);
  std::map<Monomial, Polynomial, LeadingFirst> parts;
  for (const auto& [monomial, coefficient] : polynomial) {
    Monomial chosen = monomial;
    std::erase_if(chosen, [&](const Atom& atom) { return !is_chosen(atom); });
    add(parts[chosen], monomial * inverse(chosen) * inverse(common), coefficient);
  }
  const auto written = [&](const Monomial& front, const Number& divisor) {
    std::vector<Expression> terms;
    for (const auto& [chosen, part] : parts) {
      const Number sign(all_negative(part) ? -1 : 1);
      const Expression factor = factored_form(graph, scaled(part, front, sign / divisor));
      terms.push_back(sign * (factor * to_expression(graph, chosen)));
    }
    return graph.sum(terms);
  };
  const bool worthwhile = common.size() * (parts.size() - 1) >= worthwhile_saving;
  const auto coefficient = common_coefficient(polynomial);
  if (parts.size() == 1 || common.empty() || !(worthwhile || coefficient)) return written(common, Number(1));
  Expression best = to_expression(graph, common) * written({}, Number(1));
  for (const Number& number : numeric_factors(polynomial)) {
    const Expression candidate = number * to_expression(graph, common) * written({}, number);
    if (written_length(candidate) < written_length(best)) best = candidate;
  }
  return best;
}

}  // namespace qdot
