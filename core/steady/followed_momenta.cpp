#include "core/steady/followed_momenta.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

constexpr double tie_rounding = 1e-12;

/// The scene's start as expressions of `graph`; empty where y is another state.
std::vector<Replacement> start_in(Graph& graph, const Model& model, const Start& start) {
  const auto& [parameters, y] = start;
  const Symbols& symbols = model.parsed.symbols;
  std::vector<Assignment> values;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    values.emplace_back(graph.adopt(symbols.parameters[i]), parameters[i]);
  std::vector<Replacement> result;
  const std::size_t n = y.size() / 2;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const bool is_rate = i >= n;
    const Expression value =
        graph.adopt(is_rate ? model.parsed.initial_rates[i - n] : model.parsed.initial[i]);
    if (!(std::abs(evaluate(value, values) - y[i]) <= tie_rounding * std::max(1.0, std::abs(y[i]))))
      return {};
    result.emplace_back(graph.adopt((is_rate ? symbols.coordinates.rate : symbols.coordinates.value)[i % n]),
                        value);
  }
  return result;
}

/// The symbols of the momenta, and what they are; empty where that is not known.
std::vector<Replacement> momenta_in(Graph& graph, const Dynamics& dynamics, const Reduction& reduction,
                                    const Start& from) {
  const Model& model = dynamics.model();
  const std::vector<Replacement> start = start_in(graph, model, from);
  std::vector<Replacement> result;
  if (start.empty()) return result;
  const std::size_t parameter_count = reduction.constants.size() - reduction.ignored.size();
  const std::vector<Column> columns = momentum_columns(model, reduction.ignored);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Expression p = substitute(graph.adopt(columns[c].value), start);
    if (depends_on(p, graph.adopt(model.parsed.symbols.t))) return {};
    for (const Expression& input : model.parsed.symbols.inputs.value) {
      if (depends_on(p, graph.adopt(input))) return {};
    }
    result.emplace_back(graph.adopt(reduction.constants[parameter_count + c]), p);
  }
  return result;
}

std::shared_ptr<const Statics> with_momenta(const Reduction& given, std::shared_ptr<Graph> graph,
                                            const std::vector<Replacement>& momenta) {
  Reduction own = given;
  own.graph = std::move(graph);
  for (auto* symbols : {&own.x, &own.x_dot, &own.x_ddot, &own.constants}) {
    for (Expression& e : *symbols) e = own.graph->adopt(e);
  }
  const auto put_in = [&](Expression& e) { e = substitute(own.graph->adopt(e), momenta); };
  for (auto* expressions : {&own.equations, &own.forces_at_rest, &own.ignored_rates})
    std::ranges::for_each(*expressions, put_in);
  put_in(own.routhian);
  return std::make_shared<const Statics>(statics_of(std::move(own)));
}

template <class Wanted>
std::shared_ptr<const Statics> with_momenta_if(const Dynamics& dynamics, const Reals& there,
                                               const Start& start, const Wanted& is_wanted) {
  const auto statics = dynamics.statics(there);
  const Reduction& reduction = statics->reduction;
  if (reduction.ignored.empty()) return nullptr;
  const auto graph = std::make_shared<Graph>(*reduction.graph);
  const std::vector<Replacement> momenta = momenta_in(*graph, dynamics, reduction, start);
  const bool some =
      std::ranges::any_of(momenta, [&](const Replacement& p) { return is_wanted(*graph, p.second); });
  return some ? with_momenta(reduction, graph, momenta) : nullptr;
}

}  // namespace

std::shared_ptr<const Statics> with_followed_momenta(const Dynamics& dynamics, const Reals& there,
                                                     const Start& start, std::size_t index) {
  const Expression& moving = dynamics.model().parsed.symbols.parameters[index];
  return with_momenta_if(dynamics, there, start, [&](Graph& graph, const Expression& p) {
    return depends_on(p, graph.adopt(moving));
  });
}

std::shared_ptr<const Statics> with_written_momenta(const Dynamics& dynamics, const Reals& there,
                                                    const Start& start) {
  return with_momenta_if(dynamics, there, start, [](Graph&, const Expression& p) { return !p.is_zero(); });
}

}  // namespace qdot
