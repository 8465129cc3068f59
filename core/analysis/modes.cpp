#include "core/analysis/modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/analysis/small_motions.hpp"
#include "core/compile/tape_evaluator.hpp"

namespace qdot {
namespace {

using Balls = std::vector<Ball>;
using Shape = std::vector<ComplexBall>;

/// Where no bound could be proven, numbers are told from zero by this share of the largest.
constexpr double unproven = 1e-7;

Balls evaluated(const CompiledFunction& function, const Balls& constants, const Balls& x) {
  Balls out(function.outputs());
  TapeEvaluator<Ball>(function, constants)(x, out);
  return out;
}

SquareMatrix<Ball> square_matrix(const Balls& entries, std::size_t n, std::size_t first = 0) {
  SquareMatrix<Ball> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) result(i, j) = entries[first + i * n + j];
  }
  return result;
}

std::vector<double> by_rows(const SquareMatrix<Ball>& a) {
  std::vector<double> values;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j)
      values.push_back(a(i, j).contains_zero() ? 0.0 : a(i, j).value());
  }
  return values;
}

/// (A + sign A^T)/2 by rows, or nothing where that is zero.
std::vector<double> part(const SquareMatrix<Ball>& a, int sign) {
  SquareMatrix<Ball> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j)
      result(i, j) = Ball(0.5) * (sign > 0 ? a(i, j) + a(j, i) : a(i, j) - a(j, i));
  }
  std::vector<double> values = by_rows(result);
  if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0; })) values.clear();
  return values;
}

/// A value of an eigenvalue problem, and what is proven of it.
struct Bounded {
  Ball ball;
  bool proven{};

  [[nodiscard]] std::optional<double> error() const {
    return proven ? std::optional(ball.error()) : std::nullopt;
  }
};

class Analysis {
 public:
  Analysis(const Dynamics& dynamics, std::span<const double> parameters, std::span<const double> initial)
      : dynamics_(dynamics),
        statics_(dynamics.statics(parameters)),
        constants_(parameters.begin(), parameters.end()),
        y_(initial.begin(), initial.end()) {
    for (const std::size_t k : statics_->reduction.kept) y_[total() + k] = 0;  // steady motions are at rest
    add_momenta();
  }

  Modes at(const std::optional<std::vector<double>>& given) {
    std::vector<double> guess;
    for (const std::size_t k : statics_->reduction.kept) guess.push_back(given ? (*given)[k] : y_[k]);
    place_ = find_equilibrium(dynamics_, *statics_, constants_, guess,
                              given ? EquilibriumSearch::nearest : EquilibriumSearch::stable);
    for (std::size_t c : statics_->reduction.ignored) y_[c] = given ? (*given)[c] : y_[c];
    const std::size_t n = statics_->reduction.degrees_of_freedom();
    reduced_ = {matrix(statics_->inertia, n), matrix(statics_->stiffness, n), matrix(statics_->damping, n)};
    whole_ = reduced_;
    if (statics_->linearized) {
      const Balls all = evaluated(*statics_->linearized, constants_, place_.x);
      const std::size_t entries = total() * total();
      whole_ = {square_matrix(all, total()), square_matrix(all, total(), entries),
                square_matrix(all, total(), 2 * entries)};
    }
    write_state();
    write_matrices();
    write_modes();
    write_stability();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::size_t total() const { return y_.size() / 2; }
  [[nodiscard]] const Reduction& reduction() const { return statics_->reduction; }
  [[nodiscard]] SquareMatrix<Ball> matrix(const CompiledFunction& function, std::size_t n) const {
    return square_matrix(evaluated(function, constants_, place_.x), n);
  }

  void add_momenta() {
    if (reduction().ignored.empty()) return;
    const std::vector<Column> all = momentum_columns(dynamics_.model());
    std::vector<Column> momenta;
    for (const std::size_t c : reduction().ignored) momenta.push_back(all[c]);
    const Balls p = evaluated(*dynamics_.columns(momenta), constants_, Balls(y_.begin(), y_.end()));
    constants_.insert(constants_.end(), p.begin(), p.end());
  }

  void write_state() {
    result_.y = y_;
    result_.y_error.assign(y_.size(), 0.0);
    for (std::size_t i = 0; i < reduction().kept.size(); ++i) put(reduction().kept[i], place_.x[i]);
    const Balls rates = evaluated(statics_->ignored_rates, constants_, place_.x);
    for (std::size_t c = 0; c < rates.size(); ++c) put(total() + reduction().ignored[c], rates[c]);
  }
  void put(std::size_t i, const Ball& value) {
    if (!value.is_finite()) throw Error(ErrorCode::invalid_state, "A steady rate has no finite value there.");
    result_.y[i] = value.value();
    const bool proven = place_.isolated || value.error() == 0;
    result_.y_error[i] = proven ? std::optional(value.error()) : std::nullopt;
  }

  void write_matrices() {
    result_.mass = by_rows(whole_.mass);
    result_.stiffness = by_rows(whole_.stiffness);
    result_.gyroscopic = part(whole_.rates, -1);
    result_.damping = part(whole_.rates, 1);
  }

  void write_modes() {
    for (const std::size_t c : reduction().ignored) {
      Mode rigid;
      rigid.kind = ModeKind::rigid;
      rigid.omega_error = rigid.lambda = 0.0;
      rigid.shape.assign(total(), 0.0);
      rigid.shape[c] = 1;
      result_.modes.push_back(std::move(rigid));
    }
    if (reduced_.size() > 0 && !(reduced_.depends_on_squares() && from_squares())) from_exponents();
    std::stable_sort(result_.modes.begin(), result_.modes.end(), [](const Mode& a, const Mode& b) {
      if (a.omega != b.omega) return a.omega < b.omega;
      return a.kind != b.kind ? a.kind < b.kind : a.rate > b.rate;
    });
    const auto rigid = static_cast<std::size_t>(
        std::count_if(result_.modes.begin(), result_.modes.end(),
                      [](const Mode& mode) { return mode.kind == ModeKind::rigid; }));
    for (Mode& mode : result_.modes) {
      if (mode.kind == ModeKind::rigid) mode.multiplicity = rigid;
    }
  }

  // Without gyroscopic and damping terms.

  bool from_squares() {
    const Eigensystem<Ball> found = squares(reduced_);
    const std::size_t n = found.values.size();
    for (std::size_t first = 0; first < n; ++first) {
      std::vector<std::size_t> members;
      for (std::size_t i = 0; i < n; ++i) {
        if (found.group[i] == first) members.push_back(i);
      }
      if (members.empty()) continue;
      std::vector<Shape> shapes;
      for (const std::size_t i : members) shapes.push_back(shape_of(found, i));
      const std::vector<Mode> modes = modes_of_square(found, members, shapes);
      result_.modes.insert(result_.modes.end(), modes.begin(), modes.end());
    }
    return n > 0;
  }

  template <class T>
  [[nodiscard]] Shape shape_of(const Eigensystem<T>& found, std::size_t i) const {
    Shape shape;
    for (std::size_t k = 0; k < reduced_.size(); ++k) {
      ComplexBall entry(found.vectors(k, i));
      const double bound = found.bounds[k * found.values.size() + i];
      entry.re.radius += bound;
      if constexpr (std::is_same_v<T, ComplexBall>) entry.im.radius += bound;
      shape.push_back(entry);
    }
    return shape;
  }

  [[nodiscard]] std::vector<Mode> modes_of_square(const Eigensystem<Ball>& found,
                                                  const std::vector<std::size_t>& members,
                                                  const std::vector<Shape>& shapes) const {
    std::vector<Mode> modes;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t i = members[k];
      const bool proven = std::isfinite(found.radii[i]);
      const Ball lambda(found.values[i].middle, proven ? found.radii[i] : 0);
      modes.push_back(mode_of_square({lambda, proven}, shapes[k]));
      modes.back().multiplicity = members.size();
    }
    ComplexBall s;  // only its ratio to the ignored coordinates' momenta matters, and all members share it
    const Ball first = found.values[members[0]];
    (first.middle.high < 0 ? s.re : s.im) =
        modes[0].omega == 0 && modes[0].rate == 0 ? Ball(0) : sqrt(first.middle.high < 0 ? -first : first);
    set_shapes(modes, shapes, s);
    return modes;
  }

  [[nodiscard]] Mode mode_of_square(const Bounded& lambda, const Shape& shape) const {
    Mode mode;
    if (lambda.ball.contains_zero() || std::abs(lambda.ball.value()) <= rounding_of_parameters(shape)) {
      mode.kind = is_rigid(shape) ? ModeKind::rigid : ModeKind::neutral;
      mode.lambda = 0.0;
      mode.omega_error = mode.kind == ModeKind::rigid
                             ? 0
                             : std::sqrt(std::max(lambda.ball.magnitude(), rounding_of_parameters(shape)));
      return mode;
    }
    mode.lambda = lambda.ball.value();
    const bool grows = *mode.lambda < 0;
    const Bounded root{sqrt(grows ? -lambda.ball : lambda.ball), lambda.proven};
    mode.kind = grows ? ModeKind::growth : ModeKind::oscillation;
    (grows ? mode.rate : mode.omega) = root.ball.value();
    (grows ? mode.rate_error : mode.omega_error) = root.error();
    return mode;
  }

  /// How far lambda moves when every parameter moves by half a unit in its last place.
  [[nodiscard]] double rounding_of_parameters(const Shape& shape) const {
    Balls constants = constants_;
    for (Ball& c : constants) c.radius += 0x1p-53 * std::abs(c.middle.high);
    const Balls k = evaluated(statics_->stiffness, constants, place_.x);
    const std::size_t n = reduced_.size();
    double moved = 0;
    Ball inertia;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        moved += magnitude(shape[i]) * k[i * n + j].radius * magnitude(shape[j]);
        inertia = inertia + shape[i].re * reduced_.mass(i, j) * shape[j].re;
      }
    }
    return moved / std::abs(inertia.middle.high);
  }

  /// No force appears at finite distances along the shape.
  [[nodiscard]] bool is_rigid(const Shape& shape) const {
    double size = 0;
    for (const ComplexBall& entry : shape) size = std::max(size, magnitude(entry.re));
    for (const double distance : {1.0, -0.5}) {
      Balls x = place_.x;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] + Ball(distance / size) * shape[i].re;
      const Balls g = evaluated(statics_->forces, constants_, x);
      if (!std::all_of(g.begin(), g.end(), [](const Ball& force) { return force.contains_zero(); }))
        return false;
    }
    return true;
  }

  // With them.

  void from_exponents() {
    for (const Shape& shape : kernel(reduced_.stiffness)) {
      std::vector<Mode> modes(1);
      modes[0].kind = is_rigid(shape) ? ModeKind::rigid : ModeKind::neutral;
      modes[0].omega_error = 0.0;
      set_shapes(modes, {shape}, {});
      result_.modes.push_back(modes[0]);
    }
    const Eigensystem<ComplexBall> found = exponents(reduced_);
    double largest = 0;
    for (const ComplexBall& s : found.values) largest = std::max(largest, magnitude(s));
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      const bool proven = std::isfinite(found.radii[i]);
      const double radius = proven ? found.radii[i] : unproven * largest;
      const auto members =
          static_cast<std::size_t>(std::count(found.group.begin(), found.group.end(), found.group[i]));
      add_exponent(found, i, radius, proven, members);
    }
  }

  void add_exponent(const Eigensystem<ComplexBall>& found, std::size_t i, double radius, bool proven,
                    std::size_t members) {
    const Bounded rate{{found.values[i].re.middle, radius}, proven};
    const Bounded omega{{found.values[i].im.middle, radius}, proven};
    const bool steady = rate.ball.contains_zero();
    const bool swings = !omega.ball.contains_zero();
    if (steady && !swings) return;                         // the kernel of K has it
    if (swings && omega.ball.middle.high < 0) return;      // its conjugate has it
    const bool mirrored = reduced_.undamped() && !swings;  // its mirror image has it
    if (mirrored && rate.ball.middle.high < 0) return;
    Mode mode;
    mode.multiplicity = members;
    mode.kind = steady                      ? ModeKind::oscillation
                : rate.ball.middle.high > 0 ? ModeKind::growth
                                            : ModeKind::decay;
    mode.omega = swings ? omega.ball.value() : 0;
    mode.rate = steady ? 0 : std::abs(rate.ball.value());
    mode.omega_error = swings ? omega.error() : std::nullopt;
    mode.rate_error = steady ? std::nullopt : rate.error();
    if (steady || mirrored) mode.lambda = steady ? mode.omega * mode.omega : -mode.rate * mode.rate;
    std::vector<Mode> modes{mode};
    set_shapes(modes, {shape_of(found, i)}, found.values[i]);
    result_.modes.push_back(modes[0]);
  }

  /// Shapes of modes with one s, with the ignored coordinates that move along: their momenta stay, so
  /// M_cc u_c = -(M_cx + D_cx/s) u_x.
  void set_shapes(std::vector<Mode>& modes, const std::vector<Shape>& shapes, const ComplexBall& s) const {
    std::vector<Shape> all;
    for (const Shape& shape : shapes) {
      Shape whole(total());
      for (std::size_t i = 0; i < shape.size(); ++i) whole[reduction().kept[i]] = shape[i];
      for (auto& [c, value] : companions(shape, s)) whole[c] = value;
      all.push_back(std::move(whole));
    }
    all = echelon_form(std::move(all));
    for (std::size_t k = 0; k < modes.size(); ++k) {
      modes[k].shape.clear();
      for (const ComplexBall& entry : all[k]) modes[k].shape.emplace_back(entry.re.value(), entry.im.value());
    }
  }

  [[nodiscard]] std::vector<std::pair<std::size_t, ComplexBall>> companions(const Shape& shape,
                                                                            const ComplexBall& s) const {
    const std::vector<std::size_t>& ignored = reduction().ignored;
    std::vector<std::vector<ComplexBall>> rows;  // the augmented matrix (M_cc | right-hand side)
    for (const std::size_t c : ignored) {
      rows.emplace_back();
      for (const std::size_t other : ignored) rows.back().emplace_back(whole_.mass(c, other));
      ComplexBall sum;
      for (std::size_t i = 0; i < shape.size(); ++i) {
        const std::size_t k = reduction().kept[i];
        sum = sum - whole_.mass(c, k) * shape[i];
        const bool turning = magnitude(s) > 0 && !whole_.rates(c, k).is_zero();
        if (turning) sum = sum - whole_.rates(c, k) * shape[i] / s;
      }
      rows.back().push_back(sum);
    }
    rows = echelon_form(std::move(rows));
    std::vector<std::pair<std::size_t, ComplexBall>> result;
    for (std::size_t k = 0; k < ignored.size(); ++k) result.emplace_back(ignored[k], rows[k].back());
    return result;
  }

  // What they say together.

  void write_stability() {
    const auto has = [&](ModeKind kind) {
      return std::any_of(result_.modes.begin(), result_.modes.end(),
                         [&](const Mode& mode) { return mode.kind == kind; });
    };
    result_.stability = Stability::neutral;
    if (has(ModeKind::growth)) {
      result_.stability = Stability::unstable;
    } else if (has(ModeKind::neutral)) {
      result_.undecided =
          "Along the neutral mode the stiffness is zero to within the rounding of the parameters: higher "
          "terms of the potential decide.";
    } else if (!has(ModeKind::oscillation) && !has(ModeKind::decay)) {
      result_.undecided = "Every place is an equilibrium: nothing drives the system back or away.";
    } else if (!has(ModeKind::decay) && gyroscopically_held()) {
      result_.undecided =
          "The potential has no minimum here; gyroscopic terms hold the system to first order, and "
          "linearization does not decide.";
    } else {
      result_.stability = Stability::stable;
    }
  }

  /// Undamped with a direction in which the potential falls.
  [[nodiscard]] bool gyroscopically_held() const {
    if (reduced_.depends_on_squares() || !reduced_.undamped()) return false;
    const SmallMotions at_rest{reduced_.mass, reduced_.stiffness, SquareMatrix<Ball>(reduced_.size())};
    const Eigensystem<Ball> found = squares(at_rest);
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      if (found.values[i].middle.high < -found.radii[i]) return true;
    }
    return false;
  }

  const Dynamics& dynamics_;
  std::shared_ptr<const Statics> statics_;
  Balls constants_;
  std::vector<double> y_;
  Equilibrium place_;
  SmallMotions reduced_{SquareMatrix<Ball>(0), SquareMatrix<Ball>(0), SquareMatrix<Ball>(0)};
  SmallMotions whole_ = reduced_;
  Modes result_;
};

}  // namespace

const char* name(ModeKind kind) {
  switch (kind) {
    case ModeKind::rigid:
      return "rigid";
    case ModeKind::neutral:
      return "neutral";
    case ModeKind::growth:
      return "growth";
    case ModeKind::decay:
      return "decay";
    case ModeKind::oscillation:
      break;
  }
  return "oscillation";
}

const char* name(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return "stable";
    case Stability::unstable:
      return "unstable";
    case Stability::neutral:
      break;
  }
  return "neutral";
}

Modes normal_modes(const Dynamics& dynamics, std::span<const double> parameters,
                   std::span<const double> initial, const std::optional<std::vector<double>>& guess) {
  return Analysis(dynamics, parameters, initial).at(guess);
}

}  // namespace qdot
