#include "core/turning/elastic_walls.hpp"

#include <algorithm>
#include <cmath>

#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

class Walls {
 public:
  Walls(const Model& model, const Reals& parameters, const Reals& y0)
      : model_(model), parameters_(parameters), y0_(y0), graph_(*model.parsed.graph) {}

  std::optional<ElasticWalls> found() {
    for (const ParsedImpact& impact : model_.parsed.impacts) {
      if (!turns_round(impact) || !take(impact.event)) return std::nullopt;
    }
    return std::move(walls_);
  }

 private:
  [[nodiscard]] Expression with_numbers(const Expression& e) {
    std::vector<Replacement> numbers;
    const std::vector<Expression>& symbols = model_.parsed.symbols.parameters;
    for (std::size_t i = 0; i < symbols.size(); ++i) {
      if (parameters_.exact(i).is_exact())
        numbers.emplace_back(graph_.adopt(symbols[i]), graph_.number(Number::real(parameters_[i])));
    }
    return simplify(substitute(graph_.adopt(e), numbers));
  }

  [[nodiscard]] bool turns_round(const ParsedImpact& impact) {
    const Expression &x = model_.parsed.symbols.coordinates.value[0],
                     &rate = model_.parsed.symbols.coordinates.rate[0];
    bool turns = false;
    for (const auto& [symbol, after] : impact.map) {
      const Expression before = symbol == x ? -graph_.adopt(x) : graph_.adopt(rate);
      if (!with_numbers(graph_.adopt(after) + before).is_zero()) return false;
      turns = turns || symbol == rate;
    }
    return turns;
  }

  [[nodiscard]] bool take(const std::string& name) {
    const std::vector<SceneEvent>& events = model_.scene.events;
    const auto event = std::ranges::find(events, name, &SceneEvent::name);
    const Expression w =
        graph_.adopt(model_.parsed.events[static_cast<std::size_t>(event - events.begin())].value);
    const auto place = place_of_wall(graph_, model_, w);
    if (!place || !event->when.empty()) return false;
    const Expression slope = differentiate(w, graph_.adopt(model_.parsed.symbols.coordinates.value[0]));
    return add({name, Ball::literal(value(*place))}, value(slope).value, event->direction);
  }

  /// A wall counts on the side from which its event is crossed in the right direction.
  [[nodiscard]] bool add(const ElasticWall& wall, double slope, Crossing direction) {
    const Ball beyond = wall.place - Ball::literal(y0_.exact(0));
    if (!wall.place.is_finite() || !std::isfinite(slope) || slope == 0) return false;
    const double leaving = beyond.contains_zero() ? -y0_[1] : beyond.value();
    if (leaving == 0) return false;
    const bool is_above = leaving > 0, rises = is_above == (slope > 0);
    if (direction != Crossing::either && (direction == Crossing::rising) != rises) return true;
    std::optional<ElasticWall>& nearest = is_above ? walls_.above : walls_.below;
    const bool is_nearer =
        !nearest || std::abs(beyond.value()) < std::abs((nearest->place - start()).value());
    if (is_nearer) nearest = wall;
    return true;
  }

  [[nodiscard]] Ball start() const { return Ball::literal(y0_.exact(0)); }

  [[nodiscard]] Real value(const Expression& e) const {
    std::vector<RealAssignment> values;
    const std::vector<Expression>& symbols = model_.parsed.symbols.parameters;
    for (std::size_t i = 0; i < symbols.size(); ++i) values.emplace_back(symbols[i], parameters_.exact(i));
    return evaluate_exactly(e, values);
  }

  const Model& model_;
  const Reals& parameters_;
  const Reals& y0_;
  Graph graph_;
  ElasticWalls walls_;
};

}  // namespace

std::optional<Expression> place_of_wall(Graph& graph, const Model& model, const Expression& w) {
  const Symbols& symbols = model.parsed.symbols;
  const Expression x = graph.adopt(symbols.coordinates.value[0]);
  const Expression slope = simplify(differentiate(w, x));
  const Replacement origin{x, graph.number(0)};
  const Expression offset = substitute(w, {&origin, 1});
  const auto varies = [&](const Expression& e) {
    return depends_on(e, x) || depends_on(e, symbols.coordinates.rate[0]) || depends_on(e, symbols.t) ||
           depends_on(e, symbols.inputs.value);
  };
  if (slope.is_zero() || varies(slope) || varies(offset)) return std::nullopt;
  return simplify(-offset / slope);
}

std::optional<ElasticWalls> elastic_walls(const Model& model, const Reals& parameters, const Reals& y0) {
  if (y0.size() != 2 || model.has_constraints() || model.parsed.impacts.empty()) return std::nullopt;
  return Walls(model, parameters, y0).found();
}

}  // namespace qdot
