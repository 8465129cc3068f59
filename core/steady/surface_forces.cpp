#include "core/steady/surface_forces.hpp"

#include <algorithm>

#include "core/expr/linear.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

using Places = std::vector<std::size_t>;  ///< of coordinates, ascending

constexpr std::size_t most_sets = 20;

/// All sets of k of the n first numbers; none where there are more than most_sets.
std::vector<Places> sets_of(std::size_t k, std::size_t n) {
  std::vector<Places> all{{}};
  for (std::size_t size = 0; size < k; ++size) {
    std::vector<Places> longer;
    for (const Places& set : all) {
      for (std::size_t next = set.empty() ? 0 : set.back() + 1; next < n; ++next) {
        longer.push_back(set);
        longer.back().push_back(next);
      }
    }
    if (longer.size() > 20 * most_sets) return {};
    all = std::move(longer);
  }
  return all.size() > most_sets ? std::vector<Places>{} : all;
}

/// g and A of the statics in one graph.
class SurfaceForces {
 public:
  SurfaceForces(const SurfaceStatics& whole, std::span<const Expression> absent)
      : whole_(whole),
        n_(whole.coordinates),
        m_(whole.constraints),
        graph_(std::make_shared<Graph>(*whole.statics->reduction.graph)) {
    const Reduction& reduction = whole.statics->reduction;
    std::vector<Expression> multipliers;
    for (const Expression& symbol : absent) absent_.emplace_back(graph_->adopt(symbol), graph_->number(0));
    std::vector<Replacement> without = absent_;
    for (std::size_t j = 0; j < m_; ++j) {
      multipliers.push_back(graph_->adopt(reduction.x[n_ + j]));
      without.emplace_back(multipliers.back(), graph_->number(0));
    }
    for (std::size_t i = 0; i < n_; ++i) {
      const Expression force = graph_->adopt(reduction.forces_at_rest[i]);
      forces_.push_back(substitute(force, without));
      slopes_.emplace_back();
      for (const Expression& lambda : multipliers)
        slopes_.back().push_back(simplify(differentiate(force, lambda)));
    }
  }

  SteadyForces derive() {
    const std::vector<Places> minors = sets_of(m_ + 1, n_), determinants = sets_of(m_, n_);
    if (determinants.empty() || (n_ > m_ && minors.empty()))
      undetermined_on_surface("it has too many coordinates for a search of all equilibria.");
    RestEquations equations{graph_, {}, {}};
    for (const Places& set : minors) add(bordered(set), equations);
    const Statics& statics = *whole_.statics;
    for (std::size_t j = 0; j < m_; ++j) {
      equations.rest.push_back(graph_->adopt(statics.rest[n_ + j]));
      equations.written.push_back(graph_->adopt(statics.reduction.forces_at_rest[n_ + j]));
    }
    SteadyForces result = compiled_forces(whole_.dynamics->model(), statics.reduction, equations);
    result.ignored_rates = compiled_at_rest(statics.reduction, *graph_, steady_rates());
    add_charts(minors, determinants, result);
    return result;
  }

 private:
  [[nodiscard]] std::vector<Expression> steady_rates() const {
    std::vector<Expression> rates = rates_at_rest(whole_.statics->reduction, *graph_);
    for (Expression& rate : rates) rate = substitute(rate, absent_);
    return rates;
  }

  static void add(const Expression& written, RestEquations& equations) {
    equations.rest.push_back(simplify(written));
    equations.written.push_back(equations.rest.back().is_zero() ? equations.rest.back() : written);
  }

  [[nodiscard]] Expression bordered(const Places& set) const {
    Matrix rows;
    for (const std::size_t i : set) {
      rows.push_back(slopes_[i]);
      rows.back().insert(rows.back().begin(), forces_[i]);
    }
    return determinant(rows);
  }

  [[nodiscard]] Expression of_slopes(const Places& set) const {
    Matrix rows;
    for (const std::size_t i : set) rows.push_back(slopes_[i]);
    return simplify(determinant(rows));
  }

  /// One is enough where its determinant is the same everywhere.
  void add_charts(const std::vector<Places>& minors, const std::vector<Places>& determinants,
                  SteadyForces& forces) const {
    std::vector<Expression> values;
    for (const Places& set : determinants) {
      const Expression value = of_slopes(set);
      if (value.is_zero()) continue;
      const bool is_constant = std::ranges::none_of(whole_.statics->reduction.x, [&](const Expression& x) {
        return depends_on(value, graph_->adopt(x));
      });
      if (is_constant) {
        values.clear();
        forces.charts.clear();
      }
      values.push_back(value);
      forces.charts.push_back({equations_of(set, minors, forces), set});
      if (is_constant) break;
    }
    if (values.empty()) undetermined_on_surface("they depend on each other everywhere.");
    forces.determinants = compiled_at_rest(whole_.statics->reduction, *graph_, values);
  }

  /// Where some vanish identically, others of the forces stand in for them.
  [[nodiscard]] Places equations_of(const Places& determinant, const std::vector<Places>& minors,
                                    const SteadyForces& forces) const {
    const auto vanishes = [&](std::size_t i) { return forces.rest[i].is_zero(); };
    Places chosen, others;
    for (std::size_t s = 0; s < minors.size(); ++s) {
      if (!vanishes(s)) (std::ranges::includes(minors[s], determinant) ? chosen : others).push_back(s);
    }
    for (const std::size_t s : others) {
      if (chosen.size() < n_ - m_) chosen.push_back(s);
    }
    for (std::size_t j = 0; j < m_; ++j) {
      if (!vanishes(minors.size() + j)) chosen.push_back(minors.size() + j);
    }
    return chosen;
  }

  const SurfaceStatics& whole_;
  std::size_t n_, m_;
  std::shared_ptr<Graph> graph_;
  std::vector<Replacement> absent_;
  std::vector<Expression> forces_;  ///< g
  Matrix slopes_;                   ///< A_ji, by coordinates
};

}  // namespace

SteadyForces derive_surface_forces(const SurfaceStatics& whole, std::span<const Expression> absent) {
  return SurfaceForces(whole, absent).derive();
}

std::vector<std::vector<std::size_t>> sets_of_forces(const SurfaceStatics& whole) {
  return sets_of(whole.constraints + 1, whole.coordinates);
}

}  // namespace qdot
