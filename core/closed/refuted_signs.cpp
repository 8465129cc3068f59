#include <algorithm>
#include <utility>

#include "core/closed/assumed_signs.hpp"
#include "core/closed/separation.hpp"

namespace qdot {

AssumedSigns::Chosen AssumedSigns::that_tell(const Tries& all) const {
  if (std::ranges::find(all.holds, false) == all.holds.end()) return Chosen{std::in_place};
  std::vector<std::vector<bool>> broken(open_.size());
  for (std::size_t i = 0; i < open_.size(); ++i) {
    for (const FarPlace& place : all.places) broken[i].push_back(is_broken(open_[i].e, place));
  }
  return qdot::separating(broken, all.holds);
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
  const std::vector<Expression> let_go = std::exchange(let_go_, {});
  bool is_refuted = false;
  for (std::size_t i = 0; all.has_rooms() && i < far && !is_refuted; ++i) {
    const FarPlace place = far_place(static_cast<int>(i), random);
    is_refuted = claimed_at(place, all, chosen, by_others) == false;
  }
  let_go_ = let_go;
  return is_refuted;
}

/// Whether the claim holds; none where nothing is claimed, or something is broken that is chosen.
std::optional<bool> AssumedSigns::claimed_at(const FarPlace& made_of, Tries& all,
                                             const std::vector<std::size_t>& chosen, bool by_others) const {
  const auto place = by_others ? also_(made_of) : std::optional(made_of);
  const auto is_chosen_broken = [&](std::size_t i) { return is_broken(open_[i].e, *place); };
  if (!place || std::ranges::any_of(chosen, is_chosen_broken)) return std::nullopt;
  if (!all.add(*place, made_of)) return std::nullopt;
  return all.holds.back();
}

}  // namespace qdot
