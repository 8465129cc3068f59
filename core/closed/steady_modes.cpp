#include "core/closed/steady_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/closed/exact_roots.hpp"
#include "core/closed/place_algebra.hpp"
#include "core/closed/trial.hpp"
#include "core/expr/rational_function.hpp"

namespace qdot {
namespace {

/// e = slope p^2 + rest, over what does not depend on p.
struct InSquares {
  Expression slope, rest, below;
};

std::optional<InSquares> in_squares_of(const Expression& e, const Expression& p) {
  Graph& graph = e.graph();
  const RationalFunction f = rational_function(e);
  const Expression below = to_expression(graph, f.below);
  const auto parts = linear_in(graph, f.above, p, p, 2);
  if (!parts || depends_on(below, p)) return std::nullopt;
  return InSquares{to_expression(graph, parts->slope), to_expression(graph, parts->rest), below};
}

class ModeByPlace {
 public:
  ModeByPlace(const LinearMotions& motions, const ExactValues& values)
      : values_(values),
        graph_(*motions.graph),
        x_(motions.x[0]),
        p_(motions.momenta[0]),
        force_(motions.forces[0]),
        stiffness_(motions.stiffness[0][0]),
        inertia_(motions.mass[0][0]),
        is_angle_(values.model().scene.coordinates[motions.moving[0]].unit == "rad") {}

  [[nodiscard]] std::optional<ModeForms> forms() const {
    const auto force = in_squares_of(force_, p_), stiffness = in_squares_of(stiffness_, p_);
    if (!force || !stiffness || depends_on(inertia_, p_)) return std::nullopt;
    const Expression above = stiffness->slope * force->rest - stiffness->rest * force->slope;
    const Expression below = stiffness->below * force->slope * inertia_;
    const std::vector<Expression> roots = roots_of(above, below, graph_.number(0), values_.sign_of());
    if (roots.empty()) return std::nullopt;
    const Expression momentum2 = -force->rest / force->slope;
    Trial trial = claims(momentum2, roots[0]);
    const int sign = values_.sign(roots[0]);
    if (sign == 0 || !trial.passes()) return std::nullopt;
    auto result = written(Number(sign) * roots[0], sign > 0);
    if (result) add_signs(momentum2, Number(sign) * roots[0], trial, *result);
    return result;
  }

 private:
  [[nodiscard]] Trial claims(const Expression& momentum2, const Expression& lambda) const {
    Trial trial(values_, none_);
    trial.set_given({x_});
    trial.set({p_}, {sqrt(momentum2)});
    trial.vanishes(terms_of(force_));
    trial.vanishes({stiffness_, -(inertia_ * lambda)});
    return trial;
  }

  /// That some momentum holds it there, which the formula itself does not say, and that lambda has its sign.
  void add_signs(const Expression& momentum2, const Expression& square, Trial& trial, ModeForms& mode) const {
    AssumedSigns signs(values_, none_, {x_});
    signs.ask(momentum2);
    const AssumedSigns::HoldsAt holds_at = [&](const std::vector<RealAssignment>& place) {
      const double x = std::ranges::find(place, x_, &RealAssignment::first)->second.value;
      return (is_angle_ && std::abs(x) > std::numbers::pi) || trial.holds_at(place);
    };
    const std::vector<std::string> of_place = signs.needed_for(holds_at);
    trial.is_positive(square);
    mode.form.lambda_assumes = mode.form.square.assumes;
    mode.form.lambda_assumes->insert(mode.form.lambda_assumes->end(), of_place.begin(), of_place.end());
    add_conditions(signs.needed_for(holds_at), mode.form);
  }

  [[nodiscard]] std::optional<ClosedForm> formula(const Expression& e) const {
    auto form = closed_form(values_, e, none_, {&x_, 1});
    if (form) assume_signs(*form, values_, e, {&x_, 1});
    return form;
  }

  [[nodiscard]] std::optional<ModeForms> written(const Expression& square, bool oscillates) const {
    auto form = formula(square);
    if (!form) return std::nullopt;
    const auto root = [&](const Expression& e) {
      return positive_root(graph_, rational_function(e), values_.sign_of());
    };
    ModeForms result{sqrt(square), oscillates, {.square = *std::move(form)}, {}, {}};
    result.form.rate = formula(root(square));
    if (oscillates)
      result.form.period = formula(Number(2) * graph_.symbol("pi") * root(graph_.number(1) / square));
    return result;
  }

  const ExactValues& values_;
  const Relations none_;
  Graph& graph_;
  Expression x_, p_, force_, stiffness_, inertia_;
  bool is_angle_;  ///< within half a turn to both sides
};

}  // namespace

std::optional<ModeForms> mode_by_place(const LinearMotions& motions, const ExactValues& values) {
  if (motions.x.size() != 1 || motions.momenta.size() != 1 || !motions.damping[0][0].is_zero())
    return std::nullopt;
  return ModeByPlace(motions, values).forms();
}

}  // namespace qdot
