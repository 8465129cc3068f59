#include "core/closed/mode_options.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace qdot {
namespace {

/// Shapes have no stated error; theirs is far below this.
constexpr double shapes_agree = 1e-9;

/// Relations for parameters that the equations speak of.
Relations relevant(const Relations& relations, const LinearMotions& motions) {
  std::vector<NodeId> roots;
  for (const Expression& e : motions.forces) roots.push_back(e.id());
  for (const Matrix* matrix : {&motions.mass, &motions.stiffness}) {
    for (const auto& row : *matrix) {
      for (const Expression& e : row) roots.push_back(e.id());
    }
  }
  const std::vector<NodeId> below = reachable(*motions.graph, roots);
  Relations result{{}, relations.are_defaults};
  for (const Replacement& relation : relations.replacements) {
    if (std::ranges::binary_search(below, relation.first.id())) result.replacements.push_back(relation);
  }
  return result;
}

/// The same mode with other relations put in; null where that has no form.
const LinearMode* same_mode(ModeDerivation& derivation, double value) {
  for (const LinearMode& mode : derivation.modes()) {
    if (!mode.decay.is_zero()) continue;
    if (std::abs(derivation.value(mode) - value) > shapes_agree * std::abs(value)) continue;
    return derivation.form(mode) ? &mode : nullptr;
  }
  return nullptr;
}

std::vector<ModeForms> options_of(ModeDerivation& general, ModeDerivation* related, ModeDerivation* by_scale,
                                  const ExactValues& values) {
  std::vector<ModeForms> options;
  for (const LinearMode& mode : general.modes()) {
    if (!mode.decay.is_zero()) {
      std::ranges::move(general.damped_forms(mode), std::back_inserter(options));
      continue;
    }
    const double value = general.value(mode);
    const std::optional<ClosedForm> plain = general.form(mode);
    std::size_t length = plain ? written_length(general.square(mode)) : longest_closed_form + 1;
    ModeDerivation* chosen = plain ? &general : nullptr;
    const LinearMode* best = &mode;
    for (ModeDerivation* other : {related, by_scale}) {
      const LinearMode* same = other == nullptr ? nullptr : same_mode(*other, value);
      if (same == nullptr) continue;
      const Expression square = other->square(*same);
      const std::size_t cost = written_length(square);
      const bool is_scaled = other == by_scale;
      if (is_scaled ? 2 * cost > length || !values.speaks_of_scales(square) : cost >= length) continue;
      length = cost;
      chosen = other;
      best = same;
    }
    if (chosen == nullptr) continue;
    options.push_back(chosen->forms(*best));
    if (chosen != &general && plain) options.back().form.general = general.with_signs(mode, *plain);
  }
  return options;
}

}  // namespace

std::vector<ModeForms> mode_options(const LinearMotions& motions, const ExactPlace& place,
                                    const ExactValues& values) {
  const Relations written_ones = relevant(values.relations(), motions);
  const Relations scaled = relevant(values.relations_by_scale(), motions);
  ModeDerivation general(motions, place, values, {});
  std::optional<ModeDerivation> related, by_scale;
  if (!written_ones.replacements.empty()) related.emplace(motions, place, values, written_ones);
  if (scaled.replacements.size() > written_ones.replacements.size())
    by_scale.emplace(motions, place, values, scaled);
  return options_of(general, related ? &*related : nullptr, by_scale ? &*by_scale : nullptr, values);
}

namespace {

bool grows_or_decays(const Mode& mode) {
  return mode.kind == ModeKind::growth || mode.kind == ModeKind::decay;
}

/// Of a motion without friction: omega, or the rate that it and its mirror image have.
bool is_undamped_mode(const ModeForms& option, const Mode& mode, const ExactValues& values) {
  const bool oscillates = mode.kind == ModeKind::oscillation;
  if (option.oscillates != oscillates || (!oscillates && !(grows_or_decays(mode) && mode.lambda)))
    return false;
  const std::optional<double>& error = oscillates ? mode.omega_error : mode.rate_error;
  return error && agrees(values.value(option.root), oscillates ? mode.omega : mode.rate, *error);
}

bool is_damped_mode(const ModeForms& option, const Mode& mode, const ExactValues& values) {
  if (!grows_or_decays(mode) || !mode.rate_error || option.oscillates != (mode.omega != 0)) return false;
  if (option.oscillates &&
      !(mode.omega_error && agrees(values.value(option.root), mode.omega, *mode.omega_error)))
    return false;
  const double rate = mode.kind == ModeKind::decay ? mode.rate : -mode.rate;
  return agrees(values.value(*option.decay), rate, *mode.rate_error);
}

}  // namespace

const ModeForms* option_of_mode(const std::vector<ModeForms>& options, const Mode& mode,
                                const ExactValues& values) {
  const ModeForms* only = nullptr;
  for (const ModeForms& option : options) {
    const bool is_it =
        option.decay ? is_damped_mode(option, mode, values) : is_undamped_mode(option, mode, values);
    if (!is_it) continue;
    if (only != nullptr && (only->root != option.root || only->decay != option.decay)) return nullptr;
    only = &option;
  }
  return only;
}

bool has_shape(const ModeForms& option, const Mode& mode, const ExactValues& values) {
  for (std::size_t i = 0; i < option.shape.size(); ++i) {
    const double formula = values.value(option.shape[i]).value;
    if (!(std::abs(mode.shape[i] - formula) <= shapes_agree * std::max(1.0, std::abs(formula)))) return false;
  }
  return mode.multiplicity == 1;
}

}  // namespace qdot
