#include <algorithm>

#include "core/closed/assumed_signs.hpp"

namespace qdot {

void AssumedSigns::ask_for_value_of(const Expression& e) {
  Graph& graph = e.graph();
  const Expression one = graph.number(1);
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    if (const auto* power = std::get_if<Power>(&graph.node(id))) {
      const bool is_even_root = (power->exponent.denominator() / Number(2)).is_integer();
      if (is_even_root) ask(Expression(graph, power->base));
    } else if (const auto* call = std::get_if<Call>(&graph.node(id))) {
      const Expression inside(graph, call->argument);
      const bool is_arc = call->function == Function::acos || call->function == Function::asin;
      if (call->function == Function::log) ask(inside);
      if (is_arc) {
        ask(one - inside);
        ask(one + inside);
      }
    }
  }
}

/// Of what is not needed at the first places something may be so at others, which break nothing else.
std::vector<std::size_t> AssumedSigns::with_needed_elsewhere(std::vector<std::size_t> needed,
                                                             const HoldsAt& holds_at) const {
  constexpr int most_places = 128;
  int tries = 8;
  std::minstd_rand random(most_places);
  for (int number = 0; number < most_places && tries > 0 && needed.size() < open_.size(); ++number) {
    const FarPlace place = far_place(number, random);
    if (!hold_at(needed, place)) continue;
    const auto broken =
        std::ranges::find_if(open_, [&](const Open& open) { return is_broken(open.e, place); });
    if (broken == open_.end()) continue;
    --tries;
    const auto i = static_cast<std::size_t>(broken - open_.begin());
    if (!holds_at(place)) needed.insert(std::ranges::lower_bound(needed, i), i);
  }
  return needed;
}

std::optional<FarPlace> AssumedSigns::with_other_sign(FarPlace place, std::size_t parameter) const {
  const Parameter& p = values_.model().scene.parameters[parameter];
  const Expression& symbol = values_.symbols()[parameter];
  const double other = -place[parameter].second.value;
  const bool is_related = std::ranges::find(relations_.replacements, symbol, &Replacement::first) !=
                          relations_.replacements.end();
  if (is_related || sign_of(symbol) == 0 || !p.domain.contains(other) ||
      values_.model().parsed.exponents.put_in.contains(p.name))
    return std::nullopt;
  place[parameter].second = Real(other);
  relate(place);
  return place;
}

/// Whether some claim fails with the parameter's other sign, and not at the same place with its own.
bool AssumedSigns::is_sign_needed(std::size_t parameter, const Trial& trial,
                                  const std::vector<std::size_t>& needed) const {
  int tries = 4;
  for (std::size_t k = 0; k < far_.size() && tries > 0; ++k) {
    const auto other = with_other_sign(far_[k], parameter);
    if (!other) return false;
    if (!hold_at(needed, *other)) continue;
    --tries;
    if (!trial.holds_at(*other) && (!hold_at(needed, far_[k]) || trial.holds_at(far_[k]))) return true;
  }
  return false;
}

std::vector<std::string> AssumedSigns::signs_needed_for(const Trial& trial) {
  std::vector<std::size_t> needed;
  if (are_there()) needed = numbers_needed_for([&](const FarPlace& place) { return trial.holds_at(place); });
  if (far_.empty()) find_far_places();
  std::vector<std::string> signs;
  for (std::size_t i = 0; i < values_.symbols().size(); ++i) {
    if (!is_sign_needed(i, trial, needed)) continue;
    const bool is_negative = sign_of(values_.symbols()[i]) < 0;
    signs.push_back(values_.model().scene.parameters[i].name + (is_negative ? " < 0" : " > 0"));
  }
  return signs;
}

}  // namespace qdot
