#include "core/closed/exact_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "core/base/error.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/special_angles.hpp"
#include "core/mechanics/units.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

/// Numerator and denominator of a factor worth naming, k = 2*m*g/l.
constexpr std::int64_t largest_factor = 100;

bool is_simple(const Number& number) {
  const auto small = number.small();
  return small && std::abs(small->numerator) <= largest_factor && small->denominator <= largest_factor;
}

/// Near a small fraction.
bool is_nearly_simple(double factor) {
  for (int q = 1; q <= largest_factor; ++q) {
    const double p = std::round(factor * q);
    if (p >= 1 && p <= largest_factor && std::abs(factor * q - p) < 1e-9 * p) return true;
  }
  return false;
}

/// mass^a length^b time^c squared, so that the root in sqrt(l/g) goes.
std::optional<Expression> unit_squared(Graph& graph, const ParsedScales& scales, const Dimension& dimension) {
  const auto& [mass, length, time, current] = dimension.exponents;
  const bool whole = mass.denominator == 1 && length.denominator == 1 && time.denominator == 1;
  if (!whole || current.numerator != 0) return std::nullopt;
  const auto raised = [&](const Expression& scale, int exponent) {
    return pow(pow(graph.adopt(scale), Number(2)), Number(exponent));
  };
  return raised(scales.mass, mass.numerator) * raised(scales.length, length.numerator) *
         raised(scales.time, time.numerator);
}

/// Until no value speaks of a parameter that has one: k = 2*M, M = 2*m.
void resolve(std::vector<Replacement>& replacements) {
  for (std::size_t round = 0; round < replacements.size(); ++round) {
    for (auto& [symbol, value] : replacements) value = substitute(value, replacements);
  }
}

}  // namespace

ExactValues::ExactValues(const Model& model, std::shared_ptr<Graph> graph, const WrittenTexts& written,
                         const Reals& parameters, std::optional<std::size_t> unknown)
    : model_(model), graph_(std::move(graph)), written_(written), parameters_(parameters) {
  for (const Expression& symbol : model.parsed.symbols.parameters) symbols_.push_back(graph_->adopt(symbol));
  for (std::size_t i = 0; i < symbols_.size(); ++i) values_.emplace_back(symbols_[i], parameters.exact(i));
  find_relations(unknown);
  by_scale_ = relations_;
  if (model.parsed.scales) find_scaled_relations();
}

ExactValues::ExactValues(const Model& model, const Reals& parameters)
    : model_(model), graph_(model.parsed.graph), parameters_(parameters) {
  symbols_ = model.parsed.symbols.parameters;
  for (std::size_t i = 0; i < symbols_.size(); ++i) values_.emplace_back(symbols_[i], parameters.exact(i));
}

bool ExactValues::may_have_relations(const WrittenTexts& written) const {
  const bool speaks = std::ranges::any_of(written, [](const auto& entry) {
    return std::ranges::any_of(entry.second, [](unsigned char c) { return std::isalpha(c) != 0; });
  });
  if (written.empty() || speaks || !model_.parsed.scales) return speaks;
  const ParsedScales& scales = *model_.parsed.scales;
  const double mass = value(scales.mass).value, length = value(scales.length).value,
               time = value(scales.time).value;
  for (std::size_t i = 0; i < symbols_.size(); ++i) {
    const Expression& p = symbols_[i];
    const bool is_scale =
        depends_on(scales.mass, p) || depends_on(scales.length, p) || depends_on(scales.time, p);
    const bool is_relation = !written.contains(model_.scene.parameters[i].name) &&
                             depends_on(model_.parsed.parameter_defaults[i], symbols_);
    const auto unit = parse_unit(model_.scene.parameters[i].unit);
    if (is_scale || is_relation || !unit || unit->dimension.is_dimensionless() || is_zero(i)) continue;
    const auto& e = unit->dimension.exponents;
    const auto exponent = [&](std::size_t k) {
      return static_cast<double>(e[k].numerator) / e[k].denominator;
    };
    const double factor = std::abs(parameters_[i]) /
                          (power(mass, exponent(0)) * power(length, exponent(1)) * power(time, exponent(2)));
    if (is_nearly_simple(factor)) return true;
  }
  return false;
}

std::optional<Expression> ExactValues::read(const std::string& name, const Expression& by_default) const {
  const auto found = written_.find(name);
  if (found == written_.end()) return graph_->adopt(by_default);
  std::vector<std::string> names;
  for (const Parameter& p : model_.scene.parameters) names.push_back(p.name);
  const ParseResult parsed = parse_all(found->second, *graph_, names);
  return parsed.errors.empty() ? parsed.expression : std::nullopt;
}

void ExactValues::find_relations(std::optional<std::size_t> unknown) {
  for (std::size_t i = 0; i < symbols_.size(); ++i) {
    const auto e = read(model_.scene.parameters[i].name, model_.parsed.parameter_defaults[i]);
    if (!e || is_zero(i) || i == unknown || (unknown && depends_on(*e, symbols_[*unknown]))) continue;
    if (e->number() != nullptr) numbers_.emplace_back(symbols_[i], *e);
    bool speaks_of_zero = false;
    for (std::size_t j = 0; j < symbols_.size(); ++j)
      speaks_of_zero = speaks_of_zero || (is_zero(j) && depends_on(*e, symbols_[j]));
    if (speaks_of_zero || !depends_on(*e, symbols_)) continue;
    relations_.replacements.emplace_back(symbols_[i], *e);
    relations_.are_defaults = relations_.are_defaults && !written_.contains(model_.scene.parameters[i].name);
  }
  resolve(relations_.replacements);
}

std::optional<Number> ExactValues::factor_of(const Expression& parameter, const Expression& unit) const {
  const Expression square = substitute(parameter * parameter / unit, numbers_);
  const Polynomial value = multiplied_out(square);
  if (value.size() != 1 || !value.begin()->first.empty()) return std::nullopt;
  auto root = exact_root(value.begin()->second);
  if (!root || !is_simple(*root)) return std::nullopt;
  const bool negative = this->value(parameter).value < 0;
  return negative ? -*root : *root;
}

void ExactValues::find_scaled_relations() {
  const ParsedScales& scales = *model_.parsed.scales;
  const std::vector<Expression> units{graph_->adopt(scales.mass), graph_->adopt(scales.length),
                                      graph_->adopt(scales.time)};
  for (std::size_t i = 0; i < symbols_.size(); ++i) {
    const Expression& p = symbols_[i];
    const auto is_p = [&](const Replacement& r) { return r.first == p; };
    if (std::ranges::none_of(numbers_, is_p)) continue;
    if (std::ranges::any_of(units, [&](const Expression& u) { return depends_on(u, p); })) continue;
    const auto unit = parse_unit(model_.scene.parameters[i].unit);
    if (!unit || unit->dimension == Dimension{}) continue;
    const auto square = unit_squared(*graph_, scales, unit->dimension);
    if (!square) continue;
    if (const auto factor = factor_of(p, *square)) {
      const Expression scale = positive_root(*graph_, rational_function(*square), sign_of());
      by_scale_.replacements.emplace_back(p, *factor * scale);
      by_scale_.are_defaults = false;
    }
  }
  resolve(by_scale_.replacements);
}

bool ExactValues::speaks_of_scales(const Expression& e) const {
  if (!model_.parsed.scales) return false;
  const ParsedScales& scales = *model_.parsed.scales;
  return std::ranges::all_of(symbols_, [&](const Expression& p) {
    return !depends_on(e, p) || depends_on(scales.mass, p) || depends_on(scales.length, p) ||
           depends_on(scales.time, p);
  });
}

std::optional<Expression> ExactValues::coordinate(std::size_t i) const {
  return read(model_.scene.coordinates[i].name, model_.parsed.initial[i]);
}

std::optional<Expression> ExactValues::velocity(std::size_t i) const {
  return read(model_.scene.coordinates[i].name + "_dot", model_.parsed.initial_rates[i]);
}

Real ExactValues::value(const Expression& e) const { return evaluate_exactly(e, values_); }

int ExactValues::sign(const Expression& e) const {
  const Real x = value(e);
  const bool known = x.is_finite() && std::abs(x.value) > std::abs(x.low) + x.error;
  const int answer = !known ? 0 : x.value > 0 ? 1 : -1;
  asked_.emplace_back(e, answer);
  return answer;
}

bool ExactValues::gives(const Signs& answers) const {
  return std::ranges::all_of(answers, [&](const auto& asked) { return sign(asked.first) == asked.second; });
}

}  // namespace qdot
