#include "core/motion/apart_along.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/integrate/methods.hpp"
#include "core/integrate/own_errors.hpp"
#include "core/motion/row_errors.hpp"
#include "core/numerics/random_bits.hpp"
#include "core/numerics/root.hpp"
#include "core/numerics/rough_powers.hpp"

namespace qdot {
namespace {

constexpr double looked_at =
    1e-6;  ///< of the largest component: e is looked at so large, or as it is if larger
constexpr double farthest_to_event = 0.1;  ///< as far as the other may go until it meets the event
constexpr int looks = 3;                   ///< at where that is
constexpr double times_longer = 10;        ///< times a time in which a rounded g tells no slope
constexpr double beyond_rounding = 4;      ///< times what rounding of g moves an instant: g tells there
constexpr double turn_seen = 1e3;   ///< times a short time, in which rounding does not hide how g turns
constexpr double last_places = 16;  ///< of an instant, which rounding of the motion counts

std::vector<double> along(const std::vector<double>& y, double factor, std::span<const double> direction) {
  std::vector<double> result = y;
  for (std::size_t i = 0; i < y.size(); ++i) result[i] += factor * direction[i];
  return result;
}

std::vector<double> state_after(const SectionEnd& end, double later, std::vector<double> before) {
  return end.map ? end.map(end.t + later, before) : before;
}

/// The largest |x_i| in units of what is reached.
double largest_part(std::span<const double> x, const SectionEnd& end) {
  double part = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (end.reached[i] > 0) part = std::max(part, std::abs(x[i]) / end.reached[i]);
  }
  return part;
}

/// In which the motion goes on by a small part of what is reached.
double short_time(const SectionEnd& end) {
  const double speed = largest_part(end.slopes_before, end);
  return speed > 0 ? looked_at / speed : looked_at;
}

/// As far as slopes tell how the motion goes on.
double longest_time(const SectionEnd& end) { return farthest_to_event / looked_at * short_time(end); }

/// Positions after tau at the accelerations of one side.
std::vector<double> soon(const SectionEnd& end, double tau, std::span<const double> slopes) {
  std::vector<double> y = along(end.before, tau, slopes);
  const std::size_t n = y.size() / 2;
  for (std::size_t i = 0; i < n; ++i) y[i] += tau * tau / 2 * slopes[n + i];
  return y;
}

/// Where the other meets the event far from there or never, as one of two bodies that rest beside each other
/// up to rounding: either it goes on without the impact, or it meets it with another speed g',
///
///   |e_after| <= of_places |e| + |y_after - y_before| (2 + sqrt(g'^2 + 2 |g''| |g(other) - g|)/|g'|),
///
/// or as far as anything has come, if that is less.
std::vector<double> apart_without_event(const SectionEnd& end, std::span<const double> e, double tau) {
  constexpr double of_places = 4;
  const auto g = [&](double later, const std::vector<double>& y) { return end.g(end.t + later, y); };
  const double now = g(0, end.before), ahead = g(tau, soon(end, tau, end.slopes_before)),
               behind = g(-tau, soon(end, -tau, end.slopes_before));
  const double speed = std::abs(ahead - behind) / (2 * tau);
  const double curvature = std::abs(ahead - 2 * now + behind) / (tau * tau);
  const double distance = std::abs(g(0, along(end.before, -1, e)) - now);
  const double share = 2 + std::sqrt(1 + 2 * curvature * distance / (speed * speed));
  std::vector<double> result(end.reached);
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double bound = of_places * std::abs(e[i]) + share * std::abs(end.after[i] - end.before[i]);
    if (bound < end.reached[i]) result[i] = bound;  // not, where it is no number
  }
  return result;
}

/// For how long one of both motions is beyond a kink and the other one is not, where forces turn them back on
/// either side of it: that one may graze it with another speed and miss it, or be deeper by delta,
///
///   2 (|g'| + |g'(e)| + sqrt((|g'| + |g'(e)|)^2 + 2 c delta))/c_least,   c = |g''|,
///
/// or for as long as slopes tell, where they are not turned back or velocities stand in g.
double seconds_beyond(const SectionEnd& end, std::span<const double> e, double factor, double slope) {
  const std::size_t n = e.size() / 2;
  const double tau = turn_seen * short_time(end), longest = longest_time(end);
  const double now = end.g(end.t, end.before);
  const auto turned_back = [&](std::span<const double> slopes) {
    const double ahead = end.g(end.t + tau, soon(end, tau, slopes)),
                 behind = end.g(end.t - tau, soon(end, -tau, slopes));
    return std::copysign(1.0, -slope) * (ahead - 2 * now + behind) / (tau * tau);
  };
  std::vector<double> pushed = end.before, moved = end.before;
  for (std::size_t i = 0; i < n; ++i) {
    pushed[n + i] += tau * (end.slopes_after[n + i] - end.slopes_before[n + i]);
    moved[i] -= factor * tau * e[n + i];
  }
  const double before = turned_back(end.slopes_before), after = turned_back(end.slopes_after);
  const double least = std::min(before, after), most = std::max(before, after);
  if (!(least > 0) || end.g(end.t, pushed) != now) return longest;
  const double speed = std::abs(slope) + std::abs(end.g(end.t, moved) - now) / (factor * tau);
  const double delta = std::abs(end.g(end.t, along(end.before, -factor, e)) - now) / factor;
  return std::min(longest, 2 * (speed + std::sqrt(speed * speed + 2 * most * delta)) / least);
}

/// Where forces go on as before, e does; else it is as large as the motion, or as they make it in `seconds`.
std::vector<double> apart_after_grazing(const SectionEnd& end, std::span<const double> e, double seconds) {
  std::vector<double> result(e.begin(), e.end());
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double moved = std::abs(e[i]) + seconds * std::abs(end.slopes_after[i] - end.slopes_before[i]);
    if (!(moved < end.reached[i])) return end.reached;
    result[i] = std::copysign(moved, e[i]);
  }
  return result;
}

/// Of tau, up to where g is rounding: |g| grows as tau^m there, m > 1 next to a multiple root. 1 and more
/// where g does not grow clear of its rounding until then.
double rounded_share(const SectionEnd& end, double tau) {
  const auto g_after = [&](double later) {
    return end.g(end.t + later, along(end.before, later, end.slopes_before));
  };
  const auto grown = [&](double to) { return std::abs(g_after(to) - g_after(-to)) / 2 - end.rounding; };
  const double whole = grown(tau), half = grown(tau / 2);
  if (!(half > end.rounding && whole > end.rounding)) return 1;
  const double m = std::max(1.0, rough_log2(whole) - rough_log2(half));
  return rough_exp2((rough_log2(end.rounding) - rough_log2(whole)) / m);
}

/// To the end of those before.
void move_rows(std::vector<double>& more, std::vector<double>& rows) {
  if (rows.empty())
    rows = std::move(more);
  else
    rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace

std::vector<double> apart_after(const SectionEnd& end, std::span<const double> e) {
  const double part = largest_part(e, end), shortest = short_time(end);
  const double tau = std::max(shortest, beyond_rounding * rounding_of_instant(end));
  const double looked = looked_at * (tau / shortest);
  const double factor = part > 0 ? std::max(1.0, looked / part) : 1;
  const std::vector<double> other = along(end.before, -factor, e);
  const double g = end.g(end.t, end.before);
  const auto g_of_other = [&](double later) {
    return end.g(end.t + later, along(other, later, end.slopes_before)) - g;
  };
  const double slope = (g_of_other(tau) - g_of_other(-tau)) / (2 * tau);
  double later = 0;
  for (int i = 0; i < looks; ++i) later -= g_of_other(later) / slope;
  const double farthest = longest_time(end);
  if (!(std::abs(later) < farthest))
    return end.map ? apart_without_event(end, e, tau)
                   : apart_after_grazing(end, e, seconds_beyond(end, e, factor, slope));
  std::vector<double> result = state_after(end, later, along(other, later, end.slopes_before));
  result = along(result, -later, end.slopes_after);
  for (std::size_t i = 0; i < e.size(); ++i) result[i] = (end.after[i] - result[i]) / factor;
  return std::ranges::all_of(result, [](double x) { return std::isfinite(x); }) ? result : end.reached;
}

double rounding_of_instant(const SectionEnd& end) {
  if (end.rounding == 0) return 0;
  const double shortest = short_time(end);
  for (double tau = shortest; tau < longest_time(end); tau *= times_longer) {
    const double off = tau * rounded_share(end, tau);
    if (off < tau) return off > last_places * time_round_off(end.t) ? off : 0;
  }
  return longest_time(end);
}

double seconds_apart(const SectionEnd& end, std::span<const double> errors) {
  const auto change = [&](const std::vector<double>& way, double by, double t) {
    return end.g(end.t + t, along(end.before, by, way)) - end.g(end.t - t, along(end.before, -by, way));
  };
  const double tau = short_time(end);
  const double slope = std::abs(change(end.slopes_before, tau, tau)) / (2 * tau);
  double off = 0;
  std::vector<double> way(errors.size());
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (!(errors[k] > 0)) continue;
    const double step = std::max(errors[k], looked_at * end.reached[k]);
    way[k] = 1;
    off += std::abs(change(way, step, 0)) / (2 * step) * errors[k];
    way[k] = 0;
  }
  return off > 0 ? std::min(off / slope, longest_time(end)) : 0;
}

std::vector<double> rates_of_instant(const SectionEnd& end) {
  const double tau = short_time(end);
  const std::vector<double> here = state_after(end, 0, end.before);
  std::vector<double> rates = state_after(end, tau, along(end.before, tau, end.slopes_before));
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = (rates[i] - here[i]) / tau - end.slopes_after[i];
  return rates;
}

ApartAlong::ApartAlong(const SimulationRequest& request) : is_wanted_(request.originals.has_value()) {
  if (!is_wanted_) return;
  const auto& [asked, rounded] = *request.originals;
  for (std::size_t i = 0; i < request.y_start.size(); ++i) {
    now_.by_truncation.push_back(request.y_start[i] - asked.y_start[i]);
    now_.by_rounding.push_back(request.y_start[i] - rounded.y_start[i]);
    reached_.push_back(std::abs(request.y_start[i]));
  }
}

void ApartAlong::ask(RunRequest& run, const Originals& originals) const {
  if (!is_wanted_ || !record_of(run.method).expands()) return;
  run.originals = &originals;
  run.apart = now_;
}

void ApartAlong::add(Run& done) {
  if (!is_wanted_) return;
  const std::size_t width = reached_.size(), end = rows_.all.size() + done.rows * width;
  move_rows(done.apart, rows_.all);
  move_rows(done.apart_by_rounding, rows_.by_rounding);
  for (std::size_t i = rows_.all.size(); i < end; ++i) {
    const double rounding = std::abs(now_.by_rounding[i % width]) / OwnErrors::enlarged;
    const double truncation = std::abs(now_.by_truncation[i % width]);
    rows_.all.push_back(truncation + rounding);
    rows_.by_rounding.push_back(rounding + now_.share_of_rounding * truncation);
  }
  for (std::size_t i = 0; i < width; ++i) reached_[i] = std::max(reached_[i], std::abs(done.y[i]));
  if (done.apart_at_end.reached.empty()) return;
  now_ = done.apart_at_end;
  for (std::size_t i = 0; i < width; ++i) reached_[i] = std::max(reached_[i], now_.reached[i]);
}

std::vector<double> ApartAlong::at_end() const {
  std::vector<double> apart;
  for (std::size_t i = 0; i < now_.by_truncation.size(); ++i)
    apart.push_back(std::abs(now_.by_truncation[i]) + std::abs(now_.by_rounding[i]) / OwnErrors::enlarged);
  return apart;
}

double ApartAlong::seconds(SectionEnd end, std::span<const double> unseen) const {
  end.reached = reached_;
  std::vector<double> errors = at_end();
  for (double& error : errors) error *= safety_of_differences;
  for (std::size_t k = 0; k < unseen.size(); ++k) errors[k] += unseen[k];
  const double of_instant = time_round_off(end.t) + end.doubt + end.moved;
  return std::min(of_instant + seconds_apart(end, errors), longest_time(end));
}

void ApartAlong::doubt(std::span<const double> off) {
  for (std::size_t i = 0; is_wanted_ && i < off.size(); ++i)
    now_.by_truncation[i] += std::copysign(off[i], now_.by_truncation[i]);
}

void ApartAlong::pass(SectionEnd end) {
  if (!is_wanted_) return;
  end.reached = reached_;
  now_.by_truncation = apart_after(end, now_.by_truncation);
  now_.by_rounding = apart_after(end, now_.by_rounding);
  RandomBits random(std::bit_cast<std::uint64_t>(end.t));
  const double round_off = time_round_off(end.t), longest = longest_time(end);
  const bool is_rounding = end.doubt <= last_places * round_off;
  const double doubt = std::min(is_rounding ? round_off + end.doubt : round_off, longest);
  const double late = OwnErrors::enlarged * doubt * (random.fraction() - 0.5);
  const std::vector<double> rates = rates_of_instant(end);
  const double in_common = rounding_of_instant(end) + (is_rounding ? 0 : std::min(end.doubt, longest));
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (!std::isfinite(rates[i])) continue;
    now_.by_rounding[i] += late * rates[i];
    now_.by_truncation[i] += in_common * rates[i];
  }
}

}  // namespace qdot
