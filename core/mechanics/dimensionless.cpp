#include "core/mechanics/dimensionless.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"
#include "core/mechanics/units.hpp"

namespace qdot {
namespace {

using Exponents = std::vector<Number>;  // of kg, m, s, A, or of the chosen units

Exponents exponents_of(const Dimension& dimension) {
  Exponents result;
  for (const Exponent& e : dimension.exponents) result.push_back(Number::ratio(e.numerator, e.denominator));
  return result;
}

Exponents exponents_of(const std::string& unit) {
  const auto parsed = parse_unit(unit);
  return exponents_of(parsed ? parsed->dimension : Dimension{});
}

/// x with sum_j x_j columns_j = target (Gauss-Jordan in exact numbers), the columns independent.
std::optional<Exponents> combination(const std::vector<Exponents>& columns, const Exponents& target) {
  const std::size_t n = columns.size();
  std::vector<Exponents> rows;
  for (std::size_t i = 0; i < target.size(); ++i) {
    rows.emplace_back();
    for (const Exponents& column : columns) rows.back().push_back(column[i]);
    rows.back().push_back(target[i]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                                    [k](const Exponents& row) { return !row[k].is_zero(); });
    if (pivot == rows.end()) return std::nullopt;
    std::swap(rows[k], *pivot);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == k || rows[i][k].is_zero()) continue;
      const Number factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] = rows[i][j] - factor * rows[k][j];
    }
  }
  for (std::size_t i = n; i < rows.size(); ++i) {
    if (!rows[i][n].is_zero()) return std::nullopt;
  }
  Exponents x;
  for (std::size_t k = 0; k < n; ++k) x.push_back(rows[k][n] / rows[k][k]);
  return x;
}

/// The parameters taken as units, with their dimensions.
struct UnitSystem {
  std::vector<Expression> parameters;
  std::vector<Exponents> dimensions;

  /// Adds a parameter whose dimension the others do not span.
  void offer(const Expression& parameter, const Exponents& dimension) {
    const bool dimensionless =
        std::all_of(dimension.begin(), dimension.end(), [](const Number& e) { return e.is_zero(); });
    if (dimensionless || combination(dimensions, dimension)) return;
    parameters.push_back(parameter);
    dimensions.push_back(dimension);
  }

  [[nodiscard]] std::optional<Expression> of(Graph& graph, const Exponents& dimension) const {
    const auto exponents = combination(dimensions, dimension);
    if (!exponents) return std::nullopt;
    Expression unit = graph.number(1);
    for (std::size_t k = 0; k < parameters.size(); ++k) unit = unit * pow(parameters[k], (*exponents)[k]);
    return unit;
  }
};

UnitSystem choose_units(const Scene& scene, const ParsedScene& parsed, const Lagrangian& lagrangian) {
  UnitSystem units;
  for (const bool in_scales : {true, false}) {
    for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
      const Expression& p = parsed.symbols.parameters[i];
      const bool occurs =
          parsed.scales && (depends_on(parsed.scales->mass, p) || depends_on(parsed.scales->length, p) ||
                            depends_on(parsed.scales->time, p));
      if (occurs == in_scales)
        units.offer(lagrangian.symbols.parameters[i], exponents_of(scene.parameters[i].unit));
    }
  }
  return units;
}

std::string group_name(const Scene& scene, const std::string& parameter, bool dimensionless) {
  if (scene.scales) {
    for (const auto& [name, group] : scene.scales->names) {
      if (name == parameter) return group;
    }
  }
  return dimensionless ? parameter : parameter + "_hat";
}

}  // namespace

std::optional<DimensionlessForm> dimensionless_form(const Scene& scene, const ParsedScene& parsed,
                                                    const Lagrangian& lagrangian) {
  Graph& graph = *lagrangian.graph;
  const UnitSystem units = choose_units(scene, parsed, lagrangian);
  const auto energy = units.of(graph, exponents_of("J"));
  const auto time = units.of(graph, exponents_of("s"));
  if (!energy || !time) return std::nullopt;
  DimensionlessForm form{units.parameters, {}, *energy, *time, {}};
  std::vector<Replacement> replacements;
  for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
    const Expression& p = lagrangian.symbols.parameters[i];
    const bool is_unit =
        std::find(units.parameters.begin(), units.parameters.end(), p) != units.parameters.end();
    if (is_unit) {
      replacements.emplace_back(p, graph.number(1));
      continue;
    }
    const auto scale = units.of(graph, exponents_of(scene.parameters[i].unit));
    if (!scale) return std::nullopt;
    const std::string name = group_name(scene, scene.parameters[i].name, scale->is_one());
    form.groups.push_back({name, p / *scale});
    replacements.emplace_back(p, graph.symbol(name));
  }
  form.lagrangian = simplify_by_degree(substitute(lagrangian.lagrangian, replacements), lagrangian.symbols);
  return form;
}

}  // namespace qdot
