#include "core/steady/ordered_continuation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace qdot {
namespace {

/// What takes part stands apart from all others: they are this much farther off.
constexpr double standing_apart = 3;

/// From `from` on to x, upwards.
double ahead_of(double from, double x) {
  constexpr double turn = 2 * std::numbers::pi;
  const double d = std::fmod(x - from, turn);
  return d < 0 ? d + turn : d;
}

bool brings_two(const CriticalValue* c) { return c->kind != BifurcationKind::transcritical; }

/// How many equilibria there are near a critical point on the side that has more of them, or fewer.
std::size_t number_near(const CriticalValue* c, bool more) {
  switch (c->kind) {
    case BifurcationKind::saddle_node:
      return more ? 2 : 0;
    case BifurcationKind::pitchfork:
      return more ? 3 : 1;
    default:
      return 2;
  }
}

/// A curve that passes, or all that take part in one critical point.
struct InOrder {
  double position{};
  const CriticalValue* critical{};
  std::vector<std::size_t> members;
};

/// The equilibria on one side of the step.
class OneSide {
 public:
  OneSide(const OrderedStep& step, std::span<const double> x, bool more) : step_(step), x_(x), more_(more) {}

  /// Those that take part are told by where they are: none if that is not clear.
  [[nodiscard]] std::optional<std::vector<InOrder>> in_order() const {
    std::vector<InOrder> result;
    std::vector<bool> taken(x_.size());
    for (const CriticalValue* c : step_.critical) {
      auto members = nearest(c, taken);
      if (!members) return std::nullopt;
      result.push_back({position(place(c)), c, std::move(*members)});
    }
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (!taken[i]) result.push_back({position(x_[i]), nullptr, {i}});
    }
    std::ranges::stable_sort(result, {}, &InOrder::position);
    return result;
  }

 private:
  [[nodiscard]] double place(const CriticalValue* c) const { return c->y[step_.coordinate]; }

  /// A circle is cut at the first critical point: what is near there takes part in it.
  [[nodiscard]] double position(double x) const {
    if (!step_.turns) return x;
    return ahead_of(step_.critical.empty() ? 0 : place(step_.critical.front()), x);
  }

  [[nodiscard]] double offset(std::size_t i, const CriticalValue* c) const {
    const double d = x_[i] - place(c);
    return step_.turns ? std::remainder(d, 2 * std::numbers::pi) : d;
  }

  /// Ascending.
  [[nodiscard]] std::optional<std::vector<std::size_t>> nearest(const CriticalValue* c,
                                                                std::vector<bool>& taken) const {
    const std::size_t count = number_near(c, more_);
    std::vector<std::size_t> all(x_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    if (all.size() < count) return std::nullopt;
    std::ranges::stable_sort(all, {}, [&](std::size_t i) { return std::abs(offset(i, c)); });
    if (count > 0 && all.size() > count &&
        std::abs(offset(all[count], c)) <= standing_apart * std::abs(offset(all[count - 1], c)))
      return std::nullopt;
    all.resize(count);
    for (const std::size_t i : all) {
      if (taken[i]) return std::nullopt;
      taken[i] = true;
    }
    std::ranges::stable_sort(all, {}, [&](std::size_t i) { return offset(i, c); });
    return all;
  }

  const OrderedStep& step_;
  std::span<const double> x_;
  bool more_;
};

/// Of what takes part in one critical point.
void join_at(const InOrder& before, const InOrder& after, Continuation& result) {
  const std::vector<std::size_t>&a = before.members, &b = after.members;
  const auto join = [&](std::size_t i, std::size_t k) { result.pairs.emplace_back(a[i], b[k]); };
  switch (before.critical->kind) {
    case BifurcationKind::transcritical:
      join(0, 1);
      join(1, 0);
      return;
    case BifurcationKind::pitchfork:
      join(a.size() / 2, b.size() / 2);
      break;
    default:
      break;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.size() == 2 || (a.size() == 3 && i != 1)) result.ends.emplace_back(a[i], before.critical);
  }
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.size() == 2 || (b.size() == 3 && i != 1)) result.begins.emplace_back(b[i], before.critical);
  }
}

/// Of an angle, how far all move if the order has moved past where the circle is cut by `past` places.
double farthest_move(std::span<const InOrder> before, std::span<const InOrder> after, std::size_t past) {
  double result = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double d = after[(i + past) % after.size()].position - before[i].position;
    result = std::max(result, std::abs(std::remainder(d, 2 * std::numbers::pi)));
  }
  return result;
}

bool keeps_signs(const OrderedStep& step, std::span<const InOrder> before, std::span<const InOrder> after,
                 std::size_t past) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    const InOrder& next = after[(i + past) % after.size()];
    if (step.signs_before[before[i].members[0]] * step.signs_after[next.members[0]] < 0) return false;
  }
  return true;
}

/// By as many places as move all least, if any other number moves one of them much farther. Only those that
/// change no stability count, unless none does.
std::optional<std::size_t> places_past_cut(const OrderedStep& step, std::span<const InOrder> before,
                                           std::span<const InOrder> after) {
  std::vector<std::size_t> possible;
  for (std::size_t s = 0; s < before.size(); ++s) {
    if (keeps_signs(step, before, after, s)) possible.push_back(s);
  }
  if (possible.empty()) {
    for (std::size_t s = 0; s < before.size(); ++s) possible.push_back(s);
  }
  double least = std::numeric_limits<double>::infinity(), next = least;
  std::size_t best = 0;
  for (const std::size_t s : possible) {
    const double farthest = farthest_move(before, after, s);
    next = std::min(next, std::max(farthest, least));
    if (farthest < least) {
      least = farthest;
      best = s;
    }
  }
  if (next <= standing_apart * least) return std::nullopt;
  return best;
}

}  // namespace

bool is_counted(const OrderedStep& step) {
  const auto expected = 2 * static_cast<std::size_t>(std::ranges::count_if(step.critical, brings_two));
  const std::size_t a = step.before.size(), b = step.after.size();
  return std::max(a, b) - std::min(a, b) == expected;
}

std::optional<Continuation> ordered_continuation(const OrderedStep& step) {
  const bool more_before = step.before.size() > step.after.size();
  const auto before = OneSide(step, step.before, more_before).in_order();
  const auto after = OneSide(step, step.after, !more_before).in_order();
  if (!before || !after || before->size() != after->size()) return std::nullopt;
  const std::size_t n = before->size();
  std::size_t past = 0;
  if (step.turns && step.critical.empty() && n > 1) {
    const auto found = places_past_cut(step, *before, *after);
    if (!found) return std::nullopt;
    past = *found;
  }
  Continuation result;
  for (std::size_t i = 0; i < n; ++i) {
    const InOrder &a = (*before)[i], &b = (*after)[(i + past) % n];
    if (a.critical != b.critical) return std::nullopt;
    if (a.critical != nullptr) {
      join_at(a, b, result);
    } else {
      result.pairs.emplace_back(a.members[0], b.members[0]);
    }
  }
  return result;
}

}  // namespace qdot
