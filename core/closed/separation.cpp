#include "core/closed/separation.hpp"

#include <algorithm>

namespace qdot {
namespace {

using Places = std::vector<std::size_t>;

std::size_t count_broken(const std::vector<bool>& broken, const Places& places) {
  return static_cast<std::size_t>(
      std::ranges::count_if(places, [&](std::size_t place) { return broken[place]; }));
}

/// Whether a condition that tells `told` places from the claim, and takes it from `lost`, is the better one.
struct Worth {
  std::size_t told{}, lost{};
  [[nodiscard]] bool is_better_than(const Worth& other) const {
    if (told == 0 || other.told == 0) return told > other.told;
    const std::size_t mine = lost * other.told, others = other.lost * told;
    return mine != others ? mine < others : told > other.told;
  }
};

/// Without those that others make needless.
void leave_needless_out(std::vector<std::size_t>& chosen, const std::vector<std::vector<bool>>& broken,
                        const Places& failing) {
  for (std::size_t k = 0; k < chosen.size();) {
    std::vector<std::size_t> others = chosen;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const bool suffice = std::ranges::all_of(failing, [&](std::size_t place) {
      return std::ranges::any_of(others, [&](std::size_t i) { return broken[i][place]; });
    });
    if (suffice)
      chosen = std::move(others);
    else
      ++k;
  }
}

}  // namespace

std::optional<std::vector<std::size_t>> separating(const std::vector<std::vector<bool>>& broken,
                                                   const std::vector<bool>& holds) {
  Places failing, holding;
  for (std::size_t place = 0; place < holds.size(); ++place) {
    (holds[place] ? holding : failing).push_back(place);
  }
  std::vector<std::size_t> chosen;
  for (Places open = failing; !open.empty();) {
    Worth best;
    std::size_t number = 0;
    for (std::size_t i = 0; i < broken.size(); ++i) {
      const Worth worth{count_broken(broken[i], open), count_broken(broken[i], holding)};
      if (!worth.is_better_than(best)) continue;
      best = worth;
      number = i;
    }
    if (best.told == 0) return std::nullopt;
    chosen.push_back(number);
    std::erase_if(open, [&](std::size_t place) { return broken[number][place]; });
  }
  leave_needless_out(chosen, broken, failing);
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace qdot
