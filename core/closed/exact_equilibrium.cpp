#include "core/closed/exact_equilibrium.hpp"

#include "core/closed/exact_modes.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot {
namespace {

/// The mode that has this square of its rate; its shape is not asked for.
Mode mode_of(const Interval& rate2, std::size_t coordinates) {
  Mode mode;
  mode.shape.resize(coordinates);
  mode.lambda = rate2.middle();
  const bool grows = *mode.lambda < 0;
  const Interval rate = sqrt(grows ? -rate2 : rate2);
  mode.kind = grows ? ModeKind::growth : ModeKind::oscillation;
  (grows ? mode.rate : mode.omega) = rate.middle();
  (grows ? mode.rate_error : mode.omega_error) = rate.width();
  return mode;
}

Expression negative(const Expression& e) {
  const auto* sum = std::get_if<Sum>(&e.node());
  if (sum == nullptr) return -e;
  const std::vector<NodeId> terms = sum->terms;
  Expression result = e.graph().number(0);
  for (const NodeId id : terms) result = result - Expression(e.graph(), id);
  return result;
}

ClosedForm negative(const Model& model, const ClosedForm& form) {
  Graph graph;
  std::vector<std::string> names = momentum_names(model.parsed.symbols);
  for (const Parameter& p : model.scene.parameters) names.push_back(p.name);
  for (const Coordinate& q : model.scene.coordinates) names.push_back(q.name);
  const Expression e = negative(parse(form.text, graph, names));
  const Notation notation = notation_of(model.scene);
  return {print(e, Form::text, notation), print(e, Form::latex, notation), form.assumes};
}

}  // namespace

ExactEquilibrium exact_equilibrium(const Dynamics& dynamics, const Reals& parameters,
                                   const WrittenTexts& written, const SteadyState& found,
                                   const std::vector<Real>& momenta) {
  const std::size_t n = found.y.size() / 2;
  if (!found.simple || found.at_kink) return {std::vector<std::optional<ClosedForm>>(n), std::nullopt};
  Modes modes;
  modes.y = found.y;
  modes.y_error.assign(found.errors.begin(), found.errors.end());
  modes.momenta = momenta;
  const auto& rate2 = found.stability.rate2;
  if (rate2 && rate2->is_finite() && !rate2->contains(0.0)) modes.modes.push_back(mode_of(*rate2, n));
  ExactModes exact = exact_modes(dynamics, parameters, written, modes);
  ExactEquilibrium result{std::move(exact.state), std::nullopt};
  if (exact.modes.empty() || !exact.modes[0] || exact.modes[0]->creeps) return result;
  ClosedForm square = exact.modes[0]->square;
  if (exact.modes[0]->lambda_assumes) square.assumes = *exact.modes[0]->lambda_assumes;
  result.rate2 = modes.modes[0].kind == ModeKind::growth ? negative(dynamics.model(), square) : square;
  return result;
}

}  // namespace qdot
