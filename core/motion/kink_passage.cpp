#include "core/motion/kink_passage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace qdot {
namespace {

constexpr double hardly = 0.4;  ///< of the square of a slope: what curvature does to a crossing
constexpr double several = 4;
constexpr double small_bend = 1e-2;
constexpr double short_part = 0.1;          ///< of a section
constexpr int halvings = 40;                ///< of where it may be
constexpr int most_doublings_of_time = 60;  ///< of the time in which the sign of an argument changes
constexpr int refinements = 4;  ///< of where a kink was passed, each much closer than the one before
constexpr double margin = 32 * std::numeric_limits<double>::epsilon();  ///< as in kink_ends.cpp
constexpr double rounding_of_size = 2 * std::numeric_limits<double>::epsilon();

/// As at a multiple root, or where the argument turns: a slope does not tell where its zero is.
bool is_hardly_crossed(double c0, double c1, double c2) { return std::abs(4 * c0 * c2) > hardly * c1 * c1; }

/// A zero of c0 + c1 s + c2 s^2 next to 0; far away where it is hardly crossed.
double zero_beside(double c0, double c1, double c2) {
  if (c1 == 0 && c2 == 0) return std::numeric_limits<double>::infinity();
  if (is_hardly_crossed(c0, c1, c2)) return std::sqrt(std::abs(c0 / c2)) / hardly;
  return -2 * c0 / (c1 + std::copysign(std::sqrt(c1 * c1 - 4 * c0 * c2), c1));
}

/// A kink that is to be passed.
struct Ahead {
  double u, explained;  ///< by rounding, and by a margin (kink_ends.cpp)
};

class Passing {
 public:
  Passing(SidedMotions& motions, const Sides& before, const Sides& after, std::span<const double> size)
      : motions_(motions), before_(before), after_(after), size_(size) {}

  /// One kink after the other, in order of time: where the motion changes its way at t + s, s < 0 before t,
  /// it is (f_old - f_new) s off at t, and the arguments of the others with it.
  KinkPassage pass(double duration) {
    KinkPassage passage{.move = std::vector<double>(motions_.y().size())};
    if (!find_ahead()) return passage;
    find_farthest(duration);
    const bool is_one = ahead_.size() == 1;
    std::vector<double> move(motions_.y().size());
    for (Sides now = before_; !ahead_.empty();) {
      const std::vector<std::vector<double>> old = *motions_.series(now);
      const auto zero_of = [&](const auto& one) {
        const std::vector<double>& c = old[one.first];
        return zero_beside(one.second.u, c[1], c[2]);
      };
      const auto first = std::ranges::min_element(ahead_, {}, zero_of);
      const auto [kink, here] = *first;
      double s = zero_of(*first);
      Sides next = now;
      next[kink] = after_[kink];
      ahead_.erase(first);
      if (vanishes(kink, now) || std::isinf(s)) {
        if (!motions_.series(next)) return passage;
        now = std::move(next);
        continue;
      }
      const std::vector<double>& u = old[kink];
      const bool is_hard = is_hardly_crossed(here.u, u[1], u[2]) || (is_one && !changes_beside(kink, now, s));
      const auto change = is_one && is_hard ? sign_change(kink, now, next) : std::nullopt;
      const bool is_crossed = change || !is_hardly_crossed(here.u, u[1], u[2]);
      if (change) {
        s = change->middle;
        passage.doubt = std::max(passage.doubt, change->doubt);
        passage.is_hidden = passage.is_hidden || change->doubt > motions_.resolution();
      }
      const bool is_near = change || (is_crossed && std::abs(s) <= farthest_);
      if (!change) passage.doubt = std::max(passage.doubt, rounding_of_size * size_[kink] / std::abs(u[1]));
      if (!is_near) passage.doubt = std::max(passage.doubt, std::abs(s));
      const bool is_explained = is_crossed && std::abs(here.u) <= here.explained;
      if (!(is_near || is_explained) || !motions_.series(next)) return passage;
      passage.is_unclear = passage.is_unclear || bends_on_the_way(now, next, s);
      for (auto& [k, other] : ahead_) other.u += s * (old[k][1] - (*motions_.series(next))[k][1]);
      for (std::size_t i = 0; i < move.size(); ++i)
        move[i] += s * (motions_.rate(now, i) - motions_.rate(next, i));
      passage.early = std::max(passage.early, std::abs(s));
      if (is_one && std::abs(s) > motions_.resolution()) refine(now, next, kink, s, change.has_value(), move);
      now = std::move(next);
    }
    passage.move = std::move(move);
    return passage;
  }

 private:
  /// All of a section where the last coefficients are nothing there, else a part of it.
  void find_farthest(double duration) {
    is_whole_ = ahead_.empty() || motions_.tells(before_, duration);
    farthest_ = std::max(motions_.resolution(), is_whole_ ? duration : short_part * duration);
  }

  /// Those that are passed from one way to the other; false where the way before has no series.
  bool find_ahead() {
    for (std::size_t k = 0; k < before_.size(); ++k) {
      if (before_[k] == 0 || before_[k] == after_[k]) continue;
      if (!motions_.series(before_)) return false;
      const double u = motions_.exact_argument(k, before_, motions_.t(), motions_.y());
      ahead_[k] = {u, several * (std::abs(u - (*motions_.series(before_))[k][0]) + margin * size_[k])};
    }
    return true;
  }

  /// Of the argument, before to after, along a way as a sign beyond the rounding of doubles.
  int sign_along(std::size_t kink, const Sides& sides, const std::vector<double>& rows, double s) {
    const auto y = SidedMotions::sums_at(s, rows);
    return before_[kink] * motions_.argument_sign(kink, sides, motions_.t() + s, y);
  }

  /// Whether the sign changes where coefficients say: they may be rounding.
  bool changes_beside(std::size_t kink, const Sides& sides, double s) {
    const std::vector<double>& old = motions_.rows(sides);
    const double beside = std::max(std::abs(s), motions_.resolution());
    return sign_along(kink, sides, old, s - beside) > 0 && sign_along(kink, sides, old, s + beside) < 0;
  }

  struct SignChange {
    double middle{}, doubt{};
  };
  /// Between the last place where it is seen to have one sign and the first of the other, as if there is one
  /// change.
  double middle_of_change(std::size_t kink, const Sides& sides, const std::vector<double>& rows, double first,
                          double last) {
    const auto edge = [&](const auto& is_before) {
      double from = first, to = last;
      for (int i = 0; i < halvings; ++i) {
        const double middle = (from + to) / 2;
        (is_before(sign_along(kink, sides, rows, middle)) ? from : to) = middle;
      }
      return to;
    };
    return (edge([](int s) { return s > 0; }) + edge([](int s) { return s >= 0; })) / 2;
  }

  /// Where the argument changes its sign along the old way, beyond the rounding of doubles: at a multiple
  /// root its coefficients do not tell. What was before the section is not of that way.
  std::optional<SignChange> sign_change(std::size_t kink, const Sides& sides, const Sides& next) {
    const std::vector<double> old = motions_.rows(sides);
    const auto is_clear = [&](double s, int sign) {
      return motions_.is_told(kink, sides, old, s, sign * before_[kink]);
    };
    double from = motions_.resolution(), to = from;
    for (; from < farthest_ && !is_clear(-from, 1); from = std::min(2 * from, farthest_)) {
    }
    if (!is_whole_ && !is_clear(-from, 1)) return std::nullopt;
    for (int i = 0; !is_clear(to, -1); ++i, to *= 2) {
      if (i == most_doublings_of_time ||
          !(to <= farthest_ || (motions_.tells(sides, to) && motions_.tells(next, to))))
        return std::nullopt;
    }
    double first = -from, last = to;
    const std::vector<SignPiece> pieces = motions_.argument_signs(kink, sides, old, -from, to);
    for (auto piece = pieces.begin(); piece != pieces.end() && piece->sign == before_[kink]; ++piece)
      first = piece->to;
    for (auto piece = pieces.rbegin(); piece != pieces.rend() && piece->sign == -before_[kink]; ++piece)
      last = piece->from;
    const double seen = middle_of_change(kink, sides, old, first, last);
    return SignChange{seen, std::max(last - seen, seen - first)};
  }

  /// Whether an argument vanishes altogether, as that of ||x| - x| does where x > 0: it has any side there,
  /// and no instant. Nor has one that stays what it is, such as a multiple of one on whose kink the motion
  /// is.
  bool vanishes(std::size_t kink, const Sides& sides) {
    const std::size_t row = 2 + motions_.y().size();
    const std::vector<double> places = motions_.geometry(sides, motions_.t(), motions_.y());
    const auto slopes = std::span(places).subspan(kink * row + 1, row - 1);
    return std::ranges::all_of(slopes, [](double slope) { return slope == 0; });
  }

  /// Whether what a kink changes in s seconds moves the argument of another one ahead by more than a small
  /// part of its own way: s is no short time then.
  bool bends_on_the_way(const Sides& now, const Sides& next, double s) {
    return std::ranges::any_of(ahead_, [&](const auto& one) {
      const std::vector<double> old = (*motions_.series(now))[one.first];
      const double bend = std::abs((*motions_.series(next))[one.first][2] - old[2]) * s * s;
      return bend > small_bend * std::abs(s * old[1]) + margin * size_[one.first];
    });
  }

  /// Where s is long, linear terms are not all. The argument has no more rounding at t + s than at t.
  void refine(const Sides& before, const Sides& after, std::size_t kink, const double first, bool is_known,
              std::vector<double>& move) {
    const std::vector<double>& old = motions_.rows(before);
    const std::vector<double> u = (*motions_.series(before))[kink];
    const std::size_t n = move.size() / 2;
    std::vector<double> better = move;
    double s = first;
    for (int i = 0; i < refinements; ++i) {
      if (!is_known)
        s -= motions_.exact_argument(kink, before, motions_.t() + s, SidedMotions::sums_at(s, old)) /
             (u[1] + 2 * s * u[2]);
      std::vector<double> from = motions_.y();
      for (std::size_t k = 0; k < from.size(); ++k) from[k] += better[k];
      const std::optional<std::vector<double>> rows = motions_.rows_from(after, from);
      if (!rows) return;
      const std::vector<double> wanted = SidedMotions::sums_at(s, old),
                                reached = SidedMotions::sums_at(s, *rows);
      for (std::size_t k = 0; k < n; ++k) {
        const double of_velocity = wanted[n + k] - reached[n + k];
        better[n + k] += of_velocity;
        better[k] += wanted[k] - reached[k] - s * of_velocity;
      }
    }
    const bool is_near = std::abs(s - first) <= std::abs(first);
    if (is_near && std::ranges::all_of(better, [](double x) { return std::isfinite(x); }))
      move = std::move(better);
  }

  SidedMotions& motions_;
  const Sides& before_;
  const Sides& after_;
  std::span<const double> size_;
  std::map<std::size_t, Ahead> ahead_;
  double farthest_{};  ///< back from t, where series tell the section
  bool is_whole_{};    ///< that is all of it
};

}  // namespace

KinkPassage kink_passage(SidedMotions& motions, const Sides& before, const Sides& after,
                         std::span<const double> size, double t, std::span<const double> y, double duration) {
  motions.look_from(t, y);
  return Passing(motions, before, after, size).pass(duration);
}

}  // namespace qdot
