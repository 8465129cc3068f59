#include "core/symmetry/exact_coefficients.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "core/base/error.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/zeroness.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t most_work_of_rows = 400'000;
constexpr std::size_t most_unknowns = 24;

/// Those that are numbers, and symbols for the others.
struct Proposal {
  std::vector<Expression> coefficients;
  std::vector<Expression> unknowns;
};

/// A coefficient that does not depend on the parameters has one residue at all draws.
Proposal proposed(Graph& graph, const SampledDependence& dependence) {
  Proposal proposal;
  for (std::size_t k = 0; k < dependence.first.size(); ++k) {
    const Modular value = dependence.first[k];
    const auto number = value == dependence.second[k] ? value.small_number() : std::nullopt;
    if (number) {
      proposal.coefficients.push_back(graph.number(*number));
      continue;
    }
    const std::string name = "#" + std::to_string(proposal.unknowns.size());  // no name of a scene
    proposal.unknowns.push_back(graph.symbol(name));
    proposal.coefficients.push_back(proposal.unknowns.back());
  }
  return proposal;
}

/// sum a_k u_k + a_last = 0, with a_k in the parameters.
using LinearRow = std::vector<Polynomial>;

/// The rows that make a polynomial vanish that is linear in the unknowns: one for each monomial in what is
/// neither an unknown nor made of parameters.
std::vector<LinearRow> rows_of(Graph& graph, const Polynomial& polynomial,
                               std::span<const Expression> unknowns, std::span<const Expression> parameters) {
  std::map<Monomial, LinearRow, LeadingFirst> rows;
  for (const auto& [monomial, coefficient] : polynomial) {
    Monomial varying, constant;
    std::size_t unknown = unknowns.size();
    for (const Atom& atom : monomial) {
      const auto found =
          std::ranges::find_if(unknowns, [&](const Expression& u) { return u.id() == atom.base; });
      const Expression base(graph, atom.base);
      if (found != unknowns.end()) {
        unknown = static_cast<std::size_t>(found - unknowns.begin());
      } else {
        const std::vector<NodeId> root{atom.base};
        const bool is_constant = std::ranges::all_of(reachable(graph, root), [&](NodeId id) {
          return !std::holds_alternative<Symbol>(graph.node(id)) ||
                 std::ranges::any_of(parameters, [&](const Expression& p) { return p.id() == id; });
        });
        (is_constant ? constant : varying).push_back(atom);
      }
    }
    LinearRow& row = rows[varying];
    row.resize(unknowns.size() + 1);
    add(row[unknown], constant, coefficient);
  }
  std::vector<LinearRow> result;
  for (auto& [monomial, row] : rows) result.push_back(std::move(row));
  const auto length = [](const LinearRow& row) {
    std::size_t terms = 0;
    for (const Polynomial& entry : row) terms += entry.size();
    return terms;
  };
  std::ranges::stable_sort(result, {}, length);
  return result;
}

/// Rows of rational functions, each solved for the unknown that it leads with and without it in the others.
class Elimination {
 public:
  explicit Elimination(std::size_t unknowns) : unknowns_(unknowns) {}

  void add(const LinearRow& polynomials) {
    std::vector<RationalFunction> row;
    for (const Polynomial& entry : polynomials)
      row.push_back(entry.empty() ? RationalFunction{} : in_lowest_terms(entry, {{Monomial{}, Number(1)}}));
    for (const auto& [lead, other] : solved_) reduce(row, other, lead);
    const auto lead =
        std::find_if(row.begin(), row.end() - 1, [](const auto& entry) { return !entry.is_zero(); });
    if (lead == row.end() - 1) return;
    const auto column = static_cast<std::size_t>(lead - row.begin());
    const RationalFunction scale = *lead;
    for (RationalFunction& entry : row) {
      if (!entry.is_zero()) entry = entry / scale;
    }
    for (auto& [unknown, other] : solved_) reduce(other, row, column);
    solved_.emplace(column, std::move(row));
  }
  [[nodiscard]] bool is_complete() const { return solved_.size() == unknowns_; }
  [[nodiscard]] RationalFunction solution(std::size_t unknown) const { return -solved_.at(unknown).back(); }

 private:
  static void reduce(std::vector<RationalFunction>& row, const std::vector<RationalFunction>& other,
                     std::size_t column) {
    if (row[column].is_zero()) return;
    const RationalFunction factor = row[column];
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (!other[k].is_zero()) row[k] = row[k] - factor * other[k];
    }
  }

  std::size_t unknowns_;
  std::map<std::size_t, std::vector<RationalFunction>> solved_;
};

/// A common multiple of what stands below all bars.
RationalFunction common_denominator(const std::vector<RationalFunction>& solution) {
  RationalFunction common{{{Monomial{}, Number(1)}}};
  for (const RationalFunction& value : solution) {
    if (value.is_zero()) continue;
    const Polynomial below = (value * common).below;
    const bool is_number = below.size() == 1 && below.begin()->first.empty();
    if (!is_number) common = common * RationalFunction{below};
  }
  return common;
}

std::vector<Expression> without_denominators(Graph& graph, const Proposal& proposal,
                                             const std::vector<RationalFunction>& solution) {
  const RationalFunction common = common_denominator(solution);
  const Expression factor = to_expression(graph, common);
  std::vector<Expression> result;
  std::size_t unknown = 0;
  for (const Expression& coefficient : proposal.coefficients) {
    if (coefficient.number() != nullptr) {
      result.push_back(factor * coefficient);
    } else {
      const RationalFunction& value = solution[unknown++];
      result.push_back(value.is_zero() ? graph.number(0) : to_expression(graph, value * common));
    }
  }
  return result;
}

std::optional<Polynomial> polynomial_of(const Expression& e, AngleForm angles) {
  if (angles == AngleForm::single) return normal_form(e, most_work_of_rows);
  const auto above = numerator(e, most_work_of_rows);
  return above ? std::optional(multiplied_out(*above)) : std::nullopt;
}

}  // namespace

std::optional<std::vector<Expression>> exact_coefficients(std::span<const Expression> expressions,
                                                          const SampledDependence& dependence,
                                                          std::span<const Expression> parameters,
                                                          AngleForm angles) {
  Graph& graph = expressions[0].graph();
  const Proposal proposal = proposed(graph, dependence);
  if (proposal.unknowns.empty()) return proposal.coefficients;
  if (proposal.unknowns.size() > most_unknowns) return std::nullopt;
  std::vector<Expression> terms;
  for (std::size_t k = 0; k < expressions.size(); ++k)
    terms.push_back(proposal.coefficients[k] * expressions[k]);
  const auto polynomial = polynomial_of(graph.sum(terms), angles);
  if (!polynomial) return std::nullopt;
  Elimination elimination(proposal.unknowns.size());
  for (const LinearRow& row : rows_of(graph, *polynomial, proposal.unknowns, parameters)) {
    elimination.add(row);
    if (elimination.is_complete()) break;
  }
  if (!elimination.is_complete()) return std::nullopt;
  std::vector<RationalFunction> solution;
  for (std::size_t k = 0; k < proposal.unknowns.size(); ++k) solution.push_back(elimination.solution(k));
  return without_denominators(graph, proposal, solution);
}

}  // namespace qdot
