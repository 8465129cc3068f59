#include "core/steady/bifurcation_systems.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_systems = 200;

class SystemsDerivation {
 public:
  SystemsDerivation(const Reduction& reduction, const SteadyForces& forces, std::size_t place)
      : forces_(forces), graph_(*forces.graph) {
    for (const Expression& c : reduction.constants) constants_.push_back(graph_.adopt(c));
    p_ = constants_[place];
    constants_[place] = graph_.symbol("unused constant");
    for (const Expression& x : reduction.x) all_x_.push_back(graph_.adopt(x));
    for (const std::size_t j : forces.unknowns) variables_.push_back(all_x_[j]);
    x_ = variables_;
    variables_.push_back(p_);
  }

  BifurcationSystems run() {
    for (const std::size_t i : forces_.equations) {
      const Expression g = graph_.adopt(forces_.rest[i]);
      result_.depends = result_.depends || depends_on(g, p_);
      factors_.push_back(factors_of(simplify(numerator_of(g, all_x_))));
    }
    if (result_.depends) {
      combine({}, 0, factors_.size());
      for (std::size_t i = 0; i < factors_.size(); ++i) add_meetings(i);
    }
    std::vector<Expression> slopes;
    for (const Expression& e : vanishing_) slopes.push_back(differentiate(e, p_));
    result_.vanishing = compiled(vanishing_);
    result_.vanishing_slopes = compiled(slopes);
    return std::move(result_);
  }

 private:
  /// Those that depend on x; what depends on p alone is kept apart.
  std::vector<Expression> factors_of(const Expression& g) {
    std::vector<NodeId> ids{g.id()};
    if (const auto* product = std::get_if<Product>(&g.node())) ids = product->factors;
    std::vector<Expression> result;
    for (const NodeId id : ids) {
      const Expression base = split_power(Expression(graph_, id)).base;
      if (depends_on(base, x_)) {
        result.push_back(base);
      } else if (depends_on(base, p_)) {
        vanishing_.push_back(base);
      }
    }
    return result;
  }

  void add_fold(std::vector<Expression> f) {
    Matrix jacobian;
    for (const Expression& fi : f) {
      jacobian.emplace_back();
      for (const Expression& x : x_) jacobian.back().push_back(differentiate(fi, x));
    }
    f.push_back(simplify(determinant(jacobian)));
    if (!f.back().is_zero()) add(BifurcationSystem::Kind::fold, f);
  }

  void add_meetings(std::size_t i) {
    for (std::size_t a = 0; a < factors_[i].size(); ++a) {
      for (std::size_t b = a + 1; b < factors_[i].size(); ++b) {
        combine({factors_[i][a], factors_[i][b]}, 0, i);
      }
    }
  }

  /// One factor of each force beside what is chosen of the force number `taken`; none taken: a fold.
  void combine(std::vector<Expression> chosen, std::size_t next, std::size_t taken) {
    if (next == factors_.size()) {
      return taken == factors_.size() ? add_fold(chosen) : add(BifurcationSystem::Kind::meeting, chosen);
    }
    if (next == taken) return combine(std::move(chosen), next + 1, taken);
    for (const Expression& f : factors_[next]) {
      std::vector<Expression> more = chosen;
      more.push_back(f);
      combine(std::move(more), next + 1, taken);
    }
  }

  void add(BifurcationSystem::Kind kind, const std::vector<Expression>& f) {
    // Without p in it, the system has a zero for every p or for none.
    if (std::none_of(f.begin(), f.end(), [&](const Expression& e) { return depends_on(e, p_); })) return;
    if (result_.systems.size() == most_systems) {
      throw Error(ErrorCode::not_applicable,
                  "The forces have too many factors to follow all their equilibria.");
    }
    std::vector<Expression> jacobian;
    for (const Expression& e : f) {
      for (const Expression& v : variables_) jacobian.push_back(simplify(differentiate(e, v)));
    }
    result_.systems.push_back({kind, compiled(f), compiled(jacobian)});
  }

  [[nodiscard]] CompiledFunction compiled(const std::vector<Expression>& expressions) {
    TapeBuilder tape(graph_, constants_, graph_.symbol("t"), variables_);
    for (const Expression& e : expressions) tape.output(e);
    return tape.finish();
  }

  const SteadyForces& forces_;
  Graph graph_;
  std::vector<Expression> constants_, all_x_, x_, variables_;
  Expression p_;
  std::vector<std::vector<Expression>> factors_;  ///< of each force
  std::vector<Expression> vanishing_;
  BifurcationSystems result_;
};

}  // namespace

BifurcationSystems derive_bifurcation_systems(const Reduction& reduction, const SteadyForces& forces,
                                              std::size_t place) {
  return SystemsDerivation(reduction, forces, place).run();
}

}  // namespace qdot
