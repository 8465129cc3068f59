#include "core/steady/resting_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/compile/tape_builder.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/special_angles.hpp"
#include "core/steady/factors.hpp"

namespace qdot {
namespace {

class LastingPlaces {
 public:
  LastingPlaces(const Scene& scene, const SteadyProblem& problem, std::size_t place)
      : forces_(*problem.forces), graph_(*forces_.graph) {
    const Reduction& reduction = problem.statics->reduction;
    for (const Expression& c : reduction.constants) constants_.push_back(graph_.adopt(c));
    p_.push_back(constants_[place]);
    constants_[place] = graph_.symbol("unused constant");
    for (const std::size_t j : forces_.unknowns) {
      x_.push_back(graph_.adopt(reduction.x[j]));
      v_.push_back(graph_.symbol("v of " + std::to_string(j)));
      w_.push_back(graph_.symbol("w of " + std::to_string(j)));
      domains_.push_back(scene.coordinates[reduction.kept[j]].domain);
    }
    for (const std::size_t i : forces_.equations) g_.push_back(graph_.adopt(forces_.rest[i]));
  }

  /// Those from which another curve may leave at some p.
  std::vector<LastingPlace> all() {
    std::vector<LastingPlace> places;
    std::vector<bool> half_turns(x_.size());
    for (std::size_t set = 0; set < std::size_t{1} << x_.size(); ++set) {
      bool exists = true;
      for (std::size_t k = 0; k < x_.size(); ++k) {
        half_turns[k] = (set >> k & 1U) != 0;
        exists = exists && (!half_turns[k] || forces_.turns[forces_.unknowns[k]]) &&
                 domains_[k].contains(half_turns[k] ? std::numbers::pi : 0);
      }
      if (!exists) continue;
      if (auto place = at(half_turns)) places.push_back(std::move(*place));
    }
    return places;
  }

 private:
  std::optional<LastingPlace> at(const std::vector<bool>& half_turns) {
    std::vector<Replacement> here;
    LastingPlace place;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      here.emplace_back(x_[k], half_turns[k] ? graph_.symbol("pi") : graph_.number(0));
      place.x.push_back(half_turns[k] ? Interval(std::numbers::pi, std::nextafter(std::numbers::pi, 4)) : 0);
    }
    const auto is_zero = [&](const Expression& g) { return value_at(g, here).is_zero(); };
    if (!std::ranges::all_of(g_, is_zero)) return std::nullopt;
    Matrix slopes;
    for (const Expression& g : g_) {
      slopes.emplace_back();
      for (const Expression& x : x_) slopes.back().push_back(value_at(differentiate(g, x), here));
    }
    if (!add_conditions(simplify(determinant(slopes)), place)) return std::nullopt;
    std::vector<Expression> by_rows;
    for (const auto& row : slopes) by_rows.insert(by_rows.end(), row.begin(), row.end());
    place.slopes = compiled(by_rows, p_);
    add_higher(here, place);
    place.reflected = reflections();
    return place;
  }

  [[nodiscard]] static Expression value_at(const Expression& e, const std::vector<Replacement>& here) {
    return simplify(with_special_angles(substitute(e, here)));
  }

  bool add_conditions(const Expression& determinant, LastingPlace& place) {
    if (determinant.is_zero() || !depends_on(determinant, p_[0])) return false;
    std::vector<Expression> conditions, changes;
    for (const Factor& factor : factors_along(determinant, p_[0])) {
      if (!depends_on(factor.base, p_[0])) continue;
      conditions.push_back(factor.base);
      changes.push_back(simplify(differentiate(factor.base, p_[0])));
    }
    changes.push_back(differentiate(determinant, p_[0]));
    place.conditions = compiled(conditions, p_);
    place.changes = compiled(changes, p_);
    return true;
  }

  void add_higher(const std::vector<Replacement>& here, LastingPlace& place) {
    const Expression s = graph_.symbol("step along v");
    std::vector<Replacement> along;
    for (std::size_t k = 0; k < x_.size(); ++k)
      along.emplace_back(x_[k], here[k].second + s * v_[k] + s * s * w_[k]);
    const std::vector<Replacement> start{{s, graph_.number(0)}};
    std::vector<Expression> second, third;
    for (const Expression& g : g_) {
      const Expression twice = differentiate(differentiate(substitute(g, along), s), s);
      second.push_back(value_at(twice, start));
      third.push_back(value_at(differentiate(twice, s), start));
    }
    std::vector<Expression> variables = v_;
    variables.insert(variables.end(), w_.begin(), w_.end());
    variables.push_back(p_[0]);
    place.second = compiled(second, variables);
    place.third = compiled(third, variables);
  }

  /// x -> -x of some unknowns, which is one about half a turn, too, that leaves each force what it is or its
  /// negative.
  std::vector<std::vector<bool>> reflections() {
    if (reflections_) return *reflections_;
    reflections_.emplace();
    for (std::size_t set = 1; set < std::size_t{1} << x_.size(); ++set) {
      std::vector<Replacement> reflection;
      std::vector<bool> turned(x_.size());
      for (std::size_t k = 0; k < x_.size(); ++k) {
        turned[k] = (set >> k & 1U) != 0;
        if (turned[k]) reflection.emplace_back(x_[k], -x_[k]);
      }
      const bool holds = std::ranges::all_of(g_, [&](const Expression& g) {
        const Expression image = substitute(g, reflection);
        return simplify(image - g).is_zero() || simplify(image + g).is_zero();
      });
      if (holds) reflections_->push_back(std::move(turned));
    }
    return *reflections_;
  }

  [[nodiscard]] CompiledFunction compiled(const std::vector<Expression>& expressions,
                                          const std::vector<Expression>& variables) {
    TapeBuilder tape(graph_, constants_, graph_.symbol("t"), variables);
    for (const Expression& e : expressions) tape.output(e);
    return tape.finish();
  }

  const SteadyForces& forces_;
  Graph graph_;
  std::vector<Expression> constants_, p_, x_, v_, w_, g_;
  std::vector<Domain> domains_;
  std::optional<std::vector<std::vector<bool>>> reflections_;
};

}  // namespace

std::vector<LastingPlace> resting_places(const Scene& scene, const SteadyProblem& problem,
                                         std::size_t place) {
  return LastingPlaces(scene, problem, place).all();
}

}  // namespace qdot
