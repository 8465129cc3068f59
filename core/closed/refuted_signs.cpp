#include <algorithm>
#include <cmath>
#include <utility>

#include "core/closed/assumed_signs.hpp"
#include "core/closed/separation.hpp"
#include "core/numerics/function.hpp"

namespace qdot {

void AssumedSigns::ask_one_of(const std::vector<Expression>& conditions) {
  std::vector<Expression> alternatives;
  for (const Expression& e : conditions) {
    const Real value = values_.value(e);
    if (!(value.value > value.error)) continue;
    const auto positive = sign_of(e) > 0 ? std::nullopt : positive_of(e, 1);
    if (!positive) return;
    ask(e);
    alternatives.push_back(*positive);
  }
  one_of_.push_back(std::move(alternatives));
}

AssumedSigns::Chosen AssumedSigns::that_tell(Tries& all) const {
  if (one_of_.empty() && std::ranges::find(all.holds, false) == all.holds.end()) return Chosen{std::in_place};
  all.broken.resize(open_.size());
  for (std::size_t i = 0; i < open_.size(); ++i) {
    for (std::size_t place = all.broken[i].size(); place < all.places.size(); ++place) {
      const double value = rough_value(open_[i].e, all.places[place]);
      const bool says_nothing = !all.is_real[place] && std::isnan(value);  // as the formula itself
      all.broken[i].push_back(!says_nothing && !(value > 0));
    }
  }
  // Where all of these fail, the claim does, too: a place that need not be found.
  std::vector<std::vector<bool>> broken = all.broken;
  std::vector<bool> holds = all.holds;
  for (const std::vector<Expression>& conditions : one_of_) {
    holds.push_back(false);
    for (std::size_t i = 0; i < open_.size(); ++i)
      broken[i].push_back(std::ranges::find(conditions, open_[i].e) != conditions.end());
  }
  return qdot::separating(broken, holds);
}

namespace {

/// Some part of the way from a to b, by factors; what has another sign, or is zero, stays as at a.
FarPlace place_between(FarPlace a, const FarPlace& b, double part) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double ratio = b[i].second.value / a[i].second.value;
    if (ratio > 0 && ratio != 1 && std::isfinite(ratio)) a[i].second = a[i].second.value * power(ratio, part);
  }
  return a;
}

/// How far it holds at least on a way at whose end it does not.
template <class Holds>
double holding_part(const Holds& holds) {
  constexpr int halvings = 12;
  double holding = 0, broken = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (holding + broken) / 2;
    (holds(middle) ? holding : broken) = middle;
  }
  return holding;
}

}  // namespace

/// The place with one of its numbers so many times as large; none where that is nothing to try.
std::optional<FarPlace> AssumedSigns::with_factor(FarPlace place, std::size_t i, double factor) const {
  if (i < values_.symbols().size()) {
    const Parameter& p = values_.model().scene.parameters[i];
    const double x = place[i].second.value * factor;
    if (x == 0 || !p.domain.contains(x) || values_.model().parsed.exponents.put_in.contains(p.name))
      return std::nullopt;
  }
  place[i].second = place[i].second.value * factor;
  return place;
}

/// Tries what lies just past where it is broken, on the way from the place that one number makes by itself.
/// Whether there is such a place.
bool AssumedSigns::try_past(const Expression& positive, const FarPlace& from, std::size_t i, double step,
                            Tries& all, bool by_others) const {
  constexpr int most_steps = 6;
  const auto holds = [&](double steps) {
    const auto made = with_factor(from, i, power(step, steps));
    const auto place = made ? other_place(*made, by_others) : std::nullopt;
    return !place || !is_broken(positive, *place);
  };
  int broken = 1;
  while (broken <= most_steps && holds(broken)) ++broken;
  if (broken > most_steps) return false;
  const double border = broken - 1 + holding_part([&](double part) { return holds(broken - 1 + part); });
  for (const double beyond : {0.01, 0.1, 0.5}) {
    const auto made = with_factor(from, i, power(step, border + beyond));
    const auto place = made ? other_place(*made, by_others) : std::nullopt;
    if (place) all.add(*place, *made);
  }
  return true;
}

/// A condition that no draw breaks is needed all the same where draws do not come so far: V(x0) > V(0) of a
/// start far outside of a double well.
void AssumedSigns::try_unbroken(Tries& all, bool by_others) const {
  constexpr std::size_t most_starts = 3;
  constexpr double step = 10;
  const std::vector<FarPlace> places = all.places;
  for (const Open& open : open_) {
    const auto breaks = [&](const FarPlace& place) { return is_broken(open.e, place); };
    if (std::ranges::any_of(places, breaks)) continue;
    for (std::size_t k = 0; k < std::min(most_starts, places.size()); ++k) {
      for (std::size_t i = 0; i < places[k].size(); ++i) {
        if (!try_past(open.e, places[k], i, step, all, by_others))
          (void)try_past(open.e, places[k], i, 1 / step, all, by_others);
      }
    }
  }
}

bool AssumedSigns::hold_at(const std::vector<std::size_t>& chosen, const FarPlace& place) const {
  return std::ranges::none_of(chosen, [&](std::size_t i) { return is_broken(open_[i].e, place); });
}

/// Just inside of where all that is chosen holds, on ways from places where it does, and others farther away,
/// to some where it does not: what bars a motion rises there.
bool AssumedSigns::is_refuted_inside(Tries& all, const std::vector<std::size_t>& chosen, bool by_others,
                                     std::minstd_rand& random) {
  constexpr int most_tries = 4000;
  constexpr double farther = 30;
  std::vector<FarPlace> inside, outside;
  for (const FarPlace& place : all.places) (hold_at(chosen, place) ? inside : outside).push_back(place);
  if (inside.empty() || outside.empty()) return false;
  for (int number = 0, ways = 240; number < most_tries && ways > 0; ++number) {
    FarPlace from = inside[random() % inside.size()], to = outside[random() % outside.size()];
    if (number % 2 != 0) from = place_near(from, farther, random);
    if (number % 4 > 1) to = place_near(to, farther, random);
    const auto holds = [&](double part) {
      const auto place = other_place(place_between(from, to, part), by_others);
      return place && hold_at(chosen, *place);
    };
    if (!holds(0) || holds(1)) continue;
    --ways;
    const double most = holding_part(holds);
    for (const double part : {most, 0.95 * most, 0.8 * most}) {
      if (claimed_at(place_between(from, to, part), all, chosen, by_others) == false) return true;
    }
  }
  return false;
}

std::optional<FarPlace> AssumedSigns::other_place(FarPlace place, bool by_others) const {
  relate(place);
  return by_others ? also_(place) : std::optional(place);
}

/// Next to places where the claim fails, and of ends, which are tried fast, at many far ones of the signs
/// that are given: what bars the motion may still do so where all that is chosen holds.
bool AssumedSigns::is_refuted(Tries& all, const std::vector<std::size_t>& chosen, bool by_others,
                              std::minstd_rand& random) {
  constexpr std::size_t beside = 1200, far = 2400, reaches = 4;
  std::vector<FarPlace> failing;
  for (std::size_t i = 0; i < all.places.size(); ++i)
    if (!all.holds[i]) failing.push_back(all.places[i]);
  int most = 120;
  for (std::size_t i = 0; !failing.empty() && i < beside && most > 0; ++i) {
    const double reach = 1 / (1.0 + static_cast<double>(i / failing.size() % reaches));
    const FarPlace near = place_near(failing[i % failing.size()], reach, random);
    const auto holds = claimed_at(near, all, chosen, by_others);
    if (holds) --most;
    if (holds == false) return true;
  }
  if (all.has_rooms() && is_refuted_inside(all, chosen, by_others, random)) return true;
  const std::vector<Expression> let_go = std::exchange(let_go_, {});
  bool is_refuted = false;
  for (std::size_t i = 0; all.has_rooms() && i < far && !is_refuted; ++i) {
    const FarPlace place = far_place(static_cast<int>(i), random);
    is_refuted = claimed_at(place, all, chosen, by_others) == false;
  }
  let_go_ = let_go;
  return is_refuted;
}

/// Between both signs of what is let go.
bool AssumedSigns::is_refuted_at_zeros(Tries& all, const std::vector<std::size_t>& chosen,
                                       bool by_others) const {
  constexpr int each = 3;
  std::minstd_rand random;
  bool is_refuted = false;
  for (const Expression& zero : let_go_) {
    for (int number = 0; number < each; ++number) {
      FarPlace place = far_place(number, random);
      const auto at = std::ranges::find(place, zero, &RealAssignment::first);
      const auto i = static_cast<std::size_t>(at - place.begin());
      if (i < values_.symbols().size() && !values_.model().scene.parameters[i].domain.contains(0)) break;
      at->second = Real(0);
      for (const bool by_motion : {false, true}) {
        if (!by_motion || by_others) is_refuted |= claimed_at(place, all, chosen, by_motion) == false;
      }
    }
  }
  return is_refuted;
}

/// Whether the claim holds; none where nothing is claimed, or something is broken that is chosen.
std::optional<bool> AssumedSigns::claimed_at(const FarPlace& made_of, Tries& all,
                                             const std::vector<std::size_t>& chosen, bool by_others) const {
  const auto place = other_place(made_of, by_others);
  if (!place || !hold_at(chosen, *place)) return std::nullopt;
  if (!all.add(*place, made_of)) return std::nullopt;
  return all.holds.back();
}

}  // namespace qdot
