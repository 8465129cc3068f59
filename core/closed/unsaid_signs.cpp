#include <algorithm>

#include "core/closed/assumed_signs.hpp"
#include "core/expr/print/print.hpp"

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

/// Whether it is broken at places, at none of them alone; what is broken where another is says the same.
bool AssumedSigns::is_untried(std::size_t open, const std::vector<std::size_t>& needed) const {
  const std::vector<bool>& broken = open_[open].broken;
  const auto is_another = [&](std::size_t i) { return open_[i].broken == broken; };
  if (std::ranges::any_of(needed, is_another)) return false;
  bool is_broken_somewhere = false;
  for (std::size_t place = 0; place < broken.size(); ++place) {
    if (!broken[place]) continue;
    if (std::ranges::none_of(needed, [&](std::size_t i) { return bool(open_[i].broken[place]); }))
      return false;
    is_broken_somewhere = true;
  }
  return is_broken_somewhere;
}

/// Of what was broken only together with something that is needed, some is needed as well.
std::vector<std::size_t> AssumedSigns::with_needed_elsewhere(std::vector<std::size_t> needed,
                                                             const HoldsAt& holds_at) const {
  constexpr int most_places = 128;
  int tries = 8;
  std::minstd_rand random(most_places);
  std::vector<std::size_t> untried;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (is_untried(i, needed)) untried.push_back(i);
  }
  for (int number = 0; number < most_places && tries > 0 && !untried.empty(); ++number) {
    const FarPlace place = far_place(number, random);
    if (!hold_at(needed, place)) continue;
    const auto i = std::ranges::find_if(untried, [&](std::size_t k) { return is_broken(open_[k].e, place); });
    if (i == untried.end()) continue;
    --tries;
    if (holds_at(place)) continue;
    needed.insert(std::ranges::lower_bound(needed, *i), *i);
    untried.erase(i);
  }
  return needed;
}

/// Of a parameter, or of what is given beside them, which any value may have.
std::optional<FarPlace> AssumedSigns::with_other_sign(FarPlace place, std::size_t number) const {
  const Expression symbol = place[number].first;
  const double other = -place[number].second.value;
  const bool is_related = std::ranges::find(relations_.replacements, symbol, &Replacement::first) !=
                          relations_.replacements.end();
  if (is_related || sign_of(symbol) == 0) return std::nullopt;
  if (number < values_.symbols().size()) {
    const Parameter& p = values_.model().scene.parameters[number];
    const bool is_exponent = values_.model().parsed.exponents.put_in.contains(p.name);
    if (!p.domain.contains(other) || is_exponent) return std::nullopt;
  }
  place[number].second = Real(other);
  relate(place);
  return place;
}

/// Whether some claim fails with the symbol's other sign, and not at the same place with its own.
bool AssumedSigns::is_sign_needed(std::size_t number, const Trial& trial,
                                  const std::vector<std::size_t>& needed) const {
  int tries = 4;
  for (std::size_t k = 0; k < far_.size() && tries > 0; ++k) {
    const auto other = with_other_sign(far_[k], number);
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
  for (std::size_t i = 0; i < far_[0].size(); ++i) {
    if (!is_sign_needed(i, trial, needed)) continue;
    const Expression& symbol = far_[0][i].first;
    signs.push_back(print(symbol, Form::text) + (sign_of(symbol) < 0 ? " < 0" : " > 0"));
  }
  return signs;
}

}  // namespace qdot
