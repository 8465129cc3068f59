#include "core/motion/kink_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/motion/extended_pieces.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_at_once = 4;  ///< kinks, whose combinations are tried
constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();
constexpr double far = 1e-6;         ///< of the numbers that make it up: no rounding error of u
constexpr double same_rates = 1e-9;  ///< of two ways that are one
constexpr double full_side = 1 + 1e-12;
constexpr double hardly = 0.4;  ///< of the square of a slope: what curvature does to a crossing
constexpr double several = 4;
constexpr int refinements = 4;  ///< of where a kink was passed, each much closer than the one before
constexpr double margin = 32 * std::numeric_limits<double>::epsilon();   ///< as in kink_ends.cpp
constexpr double of_state = 2 * std::numeric_limits<double>::epsilon();  ///< rounding

double norm(std::span<const double> gradient) {
  double sum = 0;
  for (const double x : gradient) sum += x * x;
  return sum;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// A zero of c0 + c1 s + c2 s^2 next to 0; far away where it is hardly crossed.
double zero_beside(double c0, double c1, double c2) {
  if (std::abs(4 * c0 * c2) > hardly * c1 * c1) return std::sqrt(std::abs(c0 / c2)) / hardly;
  return -2 * c0 / (c1 + std::copysign(std::sqrt(c1 * c1 - 4 * c0 * c2), c1));
}

/// Of series of `count` terms each.
std::vector<double> sums_at(double s, std::span<const double> rows, std::size_t count) {
  std::vector<double> sums(rows.size() / count);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (std::size_t k = count; k-- > 0;) sums[i] = sums[i] * s + rows[i * count + k];
  }
  return sums;
}

/// y -= u gradient / |gradient|^2; one component of it exactly.
void move_by(double u, std::span<const double> gradient, std::span<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (gradient[i] != 0) y[i] -= u * gradient[i] / norm(gradient);
  }
}

}  // namespace

Staying staying_on(const Sides& sides) {
  Staying staying;
  for (const int side : sides) staying.push_back(side == 0);
  return staying;
}

struct KinkModes::Mode {
  std::shared_ptr<const KinkedMotion> motion;
  TaylorExpansion expansion;
  std::vector<std::unique_ptr<TaylorComposition>> arguments;
  std::vector<double> parameters, rows;

  Mode(std::shared_ptr<const KinkedMotion> of, std::vector<double> with)
      : motion(std::move(of)), expansion(motion->accelerations, with), parameters(std::move(with)) {
    for (const auto& u : motion->arguments) {
      arguments.push_back(std::make_unique<TaylorComposition>(u, parameters));
    }
  }

  /// s_k where the motion stays.
  [[nodiscard]] double side(std::size_t kink, double t, std::span<const double> y) const {
    Workspace workspace = motion->sides[kink]->bind(parameters);
    double s{};
    const bool ok = motion->sides[kink]->evaluate(t, y, workspace, {&s, 1}) == Evaluation::ok;
    return ok ? s : std::numeric_limits<double>::quiet_NaN();
  }
};

KinkModes::KinkModes(const Dynamics& dynamics, std::span<const double> parameters, double resolution)
    : dynamics_(dynamics),
      kinks_(*dynamics.kinks()),
      parameters_(parameters.begin(), parameters.end()),
      resolution_(resolution) {}

KinkModes::~KinkModes() = default;

std::vector<double> KinkModes::parameters(const Sides& sides) const {
  std::vector<double> all = parameters_;
  all.insert(all.end(), sides.begin(), sides.end());
  return all;
}

std::shared_ptr<const KinkedMotion> KinkModes::motion(const Sides& sides) const {
  return dynamics_.kinked(staying_on(sides));
}

KinkModes::Mode* KinkModes::mode(const Sides& sides) {
  const auto [place, is_new] = modes_.try_emplace(sides);
  if (is_new) {
    if (auto functions = motion(sides)) {
      place->second = std::make_unique<Mode>(std::move(functions), parameters(sides));
    }
  }
  return place->second.get();
}

/// For each kink u, du/dt, du/dq, du/dq'; no numbers where they have no values, which integration will meet.
std::vector<double> KinkModes::geometry(const Sides& sides, double t, std::span<const double> y) {
  Workspace workspace = kinks_.geometry.bind(parameters(sides));
  std::vector<double> values(kinks_.geometry.outputs());
  if (kinks_.geometry.evaluate(t, y, workspace, values) == Evaluation::ok) return values;
  return std::vector<double>(values.size(), std::numeric_limits<double>::quiet_NaN());
}

/// The sides of those that are not active; what stands in a kink's u are sides of kinks before it.
Sides KinkModes::completed(Sides sides, double t, std::span<const double> y) {
  const std::size_t row = 2 + y.size();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (std::ranges::find(active_, k) != active_.end()) continue;
    sides[k] = geometry(sides, t, y)[k * row] < 0 ? -1 : 1;
  }
  return sides;
}

Sides KinkModes::sides_at(double t, std::span<const double> y) {
  active_.clear();
  return completed(Sides(kinks_.size(), 1), t, y);
}

std::optional<KinkModes::Way> KinkModes::way_on(double t, std::span<const double> y,
                                                const std::vector<bool>& met) {
  const Sides sides = sides_at(t, y);
  const std::vector<double> places = geometry(sides, t, y);
  const std::size_t row = 2 + y.size();
  std::vector<double> sizes;
  for (std::size_t k = 0; k < kinks_.size(); ++k) {
    const std::span<const double> of_kink(places.data() + k * row, row);
    double size = std::abs(of_kink[1] * t);
    for (std::size_t i = 0; i < y.size(); ++i) size += std::abs(of_kink[2 + i] * y[i]);
    sizes.push_back(size);
    if (std::abs(of_kink[0]) <= (met[k] ? std::max(far * size, far) : round_off * size)) active_.push_back(k);
  }
  Way way{sides, std::vector<unsigned>(sides.size()), sizes, {}};
  if (active_.empty()) return way;
  if (active_.size() > most_at_once) return std::nullopt;
  t_ = t;
  y_.assign(y.begin(), y.end());
  series_.clear();
  const std::optional<Sides> only = only_way();
  if (!only) return std::nullopt;
  way.sides = *only;
  for (const std::size_t k : active_) {
    const std::optional<Lead> first = way.sides[k] == 0 ? std::nullopt : lead(way.sides, k);
    const bool leaves = first && first->sign != 0;
    if (leaves) way.contact[k] = first->power;
    if (!leaves || first->power > 1) way.begins.push_back(k);
  }
  return way;
}

void KinkModes::settle(const Way& way, double t, std::vector<double>& y) {
  for (const std::size_t k : way.begins) put_on(k, way.sides, t, y);
}

/// u beyond the rounding of doubles, which all computations of a motion have in common.
double KinkModes::exact_argument(std::size_t kink, const Sides& sides, double t, std::span<const double> y) {
  const Mode& with = *mode(sides);
  const std::vector<DoubleDouble> constants(with.parameters.begin(), with.parameters.end());
  ExtendedFunction u(*with.motion->arguments[kink], constants);
  return u(t, std::vector<DoubleDouble>(y.begin(), y.end())).front().value();
}

/// y' of the motion that was looked at last.
std::vector<double> KinkModes::rates(const Sides& sides) {
  std::vector<double> result;
  for (std::size_t i = 0; i < y_.size(); ++i) result.push_back(mode(sides)->rows[i * (order + 1) + 1]);
  return result;
}

/// Those that are passed from one way to the other.
std::optional<std::map<std::size_t, KinkModes::Ahead>> KinkModes::kinks_ahead(const Sides& before,
                                                                              const Way& after) {
  std::map<std::size_t, Ahead> ahead;
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (before[k] == 0 || before[k] == after.sides[k]) continue;
    if (!series(before)) return std::nullopt;
    const double u = exact_argument(k, before, t_, y_);
    ahead[k] = {u, several * (std::abs(u - (*series(before))[k][0]) + margin * after.size[k])};
  }
  return ahead;
}

/// Whether an argument vanishes altogether, as that of ||x| - x| does where x > 0: it has any side there, and
/// no instant.
bool KinkModes::vanishes(std::size_t kink, const Sides& sides) {
  const std::size_t row = 2 + y_.size();
  const std::vector<double> places = geometry(sides, t_, y_);
  return norm(std::span(places).subspan(kink * row + 1, row - 1)) == 0;
}

/// One kink after the other, in order of time: where the motion changes its way at t + s, s < 0 before t, it
/// is (f_old - f_new) s off at t, and the arguments of the others with it.
KinkModes::Passage KinkModes::passage(const Sides& before, const Way& after, double t,
                                      std::span<const double> y, double farthest) {
  t_ = t;
  y_.assign(y.begin(), y.end());
  series_.clear();
  Passage passage{.move = std::vector<double>(y.size())};
  std::optional<std::map<std::size_t, Ahead>> met = kinks_ahead(before, after);
  if (!met) return passage;
  std::map<std::size_t, Ahead>& ahead = *met;
  const bool is_one = ahead.size() == 1;
  std::vector<double> move(y.size());
  for (Sides now = before; !ahead.empty();) {
    const std::vector<std::vector<double>> old = *series(now);
    const auto zero_of = [&](const auto& one) {
      const std::vector<double>& c = old[one.first];
      return zero_beside(one.second.u, c[1], c[2]);
    };
    const auto first = std::ranges::min_element(ahead, {}, zero_of);
    const std::size_t kink = first->first;
    const double s = zero_of(*first);
    if (vanishes(kink, now)) {
      now[kink] = after.sides[kink];
      ahead.erase(first);
      if (!series(now)) return passage;
      continue;
    }
    passage.doubt = std::max(passage.doubt, of_state * after.size[kink] / std::abs(old[kink][1]));
    if (!(std::abs(s) <= farthest)) passage.doubt = std::max(passage.doubt, std::abs(s));
    if (!(std::abs(s) <= farthest || std::abs(first->second.u) <= first->second.explained)) return passage;
    const std::vector<double> rate = rates(now);
    now[kink] = after.sides[kink];
    ahead.erase(first);
    if (!series(now)) return passage;
    for (auto& [k, other] : ahead) other.u += s * (old[k][1] - (*series(now))[k][1]);
    const std::vector<double> next = rates(now);
    for (std::size_t i = 0; i < y.size(); ++i) move[i] += s * (rate[i] - next[i]);
    passage.early = std::max(passage.early, std::abs(s));
    if (is_one && std::abs(s) > resolution_) refine({before, now, kink, s}, move);
  }
  passage.move = std::move(move);
  return passage;
}

/// Where s is long, linear terms are not all. The argument has no more rounding at t + s than at t.
void KinkModes::refine(const Change& change, std::vector<double>& move) {
  const std::vector<double> old = mode(change.before)->rows;
  const std::vector<double> u = (*series(change.before))[change.kink];
  Mode& with = *mode(change.after);
  const std::size_t n = y_.size() / 2;
  std::vector<double> better = move;
  double s = change.s;
  for (int i = 0; i < refinements; ++i) {
    const std::vector<double> there = sums_at(s, old, order + 1);
    s -= exact_argument(change.kink, change.before, t_ + s, there) / (u[1] + 2 * s * u[2]);
    std::vector<double> from = y_;
    for (std::size_t k = 0; k < from.size(); ++k) from[k] += better[k];
    if (with.expansion.expand(t_, from, order, with.rows) != Evaluation::ok) return;
    const std::vector<double> wanted = sums_at(s, old, order + 1), reached = sums_at(s, with.rows, order + 1);
    for (std::size_t k = 0; k < n; ++k) {
      const double of_velocity = wanted[n + k] - reached[n + k];
      better[n + k] += of_velocity;
      better[k] += wanted[k] - reached[k] - s * of_velocity;
    }
  }
  series_.erase(change.after);
  const bool is_near = std::abs(s - change.s) <= std::abs(change.s);
  if (is_near && std::ranges::all_of(better, [](double x) { return std::isfinite(x); }))
    move = std::move(better);
}

/// All combinations for the active kinks.
std::optional<Sides> KinkModes::only_way() {
  std::vector<Sides> found;
  std::size_t count = 1;
  for (std::size_t i = 0; i < active_.size(); ++i) count *= 3;
  for (std::size_t number = 0; number < count; ++number) {
    Sides sides(kinks_.size(), 1);
    for (std::size_t i = 0, rest = number; i < active_.size(); ++i, rest /= 3) {
      sides[active_[i]] = 1 - static_cast<int>(rest % 3);
    }
    sides = completed(sides, t_, y_);
    const Verdict verdict = judge(sides);
    if (verdict == Verdict::yes) found.insert(found.begin(), sides);
    if (verdict == Verdict::neutral) found.push_back(sides);
  }
  if (found.empty()) return std::nullopt;
  const bool is_one = std::ranges::all_of(found, [&](const Sides& s) { return is_same_motion(found[0], s); });
  return is_one ? std::optional(found.front()) : std::nullopt;
}

KinkModes::Verdict KinkModes::judge(const Sides& sides) {
  if (!series(sides)) return Verdict::no;
  Verdict verdict = Verdict::yes;
  for (const std::size_t k : active_) {
    if (sides[k] == 0) {
      if (!(std::abs(mode(sides)->side(k, t_, y_)) <= full_side) || !attracts(sides, k)) return Verdict::no;
      continue;
    }
    const std::optional<Lead> first = lead(sides, k);
    if (!first || first->sign == -sides[k]) return Verdict::no;
    if (first->sign == 0) verdict = Verdict::neutral;
  }
  return verdict;
}

bool KinkModes::attracts(Sides sides, std::size_t kink) {
  sides[kink] = 1;
  const std::optional<Lead> above = lead(sides, kink);
  sides[kink] = -1;
  const std::optional<Lead> below = lead(sides, kink);
  return above && below && above->sign < 0 && below->sign > 0;
}

const KinkModes::Series& KinkModes::series(const Sides& sides) {
  const auto [place, is_new] = series_.try_emplace(sides);
  Series& result = place->second;
  Mode* const with = is_new ? mode(sides) : nullptr;
  if (with == nullptr) return result;
  with->rows.resize(y_.size() * (order + 1));
  if (with->expansion.expand(t_, y_, order, with->rows) != Evaluation::ok) return result;
  if (!std::ranges::all_of(with->rows, [](double c) { return std::isfinite(c); })) return result;
  result.emplace();
  for (const auto& u : with->arguments) {
    std::vector<double>& c = result->emplace_back(order + 1);
    (void)u->expand(t_, with->rows, order, resolution_, order, c);
  }
  return result;
}

/// The coefficient that rules when time first can be told apart.
std::optional<KinkModes::Lead> KinkModes::lead(const Sides& sides, std::size_t kink) {
  const Series& all = series(sides);
  if (!all) return std::nullopt;
  Lead result;
  double largest = 0, power = resolution_;
  for (unsigned k = 1; k <= order; ++k, power *= resolution_) {
    const double c = (*all)[kink][k], size = std::abs(c) * power;
    if (std::isnan(c)) return std::nullopt;
    if (size > largest) {
      largest = size;
      result = {c > 0 ? 1 : -1, k};
    }
  }
  return result;
}

bool KinkModes::is_same_motion(const Sides& one, const Sides& other) {
  const std::vector<double>&a = mode(one)->rows, &b = mode(other)->rows;
  for (std::size_t i = 2; i < a.size(); ++i) {
    if (i % (order + 1) < 2) continue;
    if (std::abs(a[i] - b[i]) > same_rates * std::max(std::abs(a[i]), std::abs(b[i]))) return false;
  }
  return true;
}

/// u = 0, without what is rounded inside of it, and where no velocity stands in u, u' = 0.
void KinkModes::put_on(std::size_t kink, const Sides& sides, double t, std::vector<double>& y) {
  const std::size_t n = y.size() / 2, row = 2 + 2 * n;
  for (int i = 0; i < 2; ++i) {
    const std::vector<double> places = geometry(sides, t, y);
    const std::span<const double> of_kink(places.data() + kink * row, row);
    const auto by_q = of_kink.subspan(2, n), by_v = of_kink.subspan(2 + n, n);
    const std::span<double> q(y.data(), n), v(y.data() + n, n);
    double size = std::abs(of_kink[1] * t);
    for (std::size_t k = 0; k < 2 * n; ++k) size += std::abs(of_kink[2 + k] * y[k]);
    const double u = std::abs(of_kink[0]) > round_off * size ? exact_argument(kink, sides, t, y) : of_kink[0];
    if (norm(by_v) > 0) {
      move_by(u, by_v, v);
    } else if (norm(by_q) > 0) {
      move_by(u, by_q, q);
      move_by(of_kink[1] + dot(by_q, v), by_q, v);
    }
  }
}

}  // namespace qdot
