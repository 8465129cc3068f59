#include "core/steady/mode_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"

namespace qdot {
namespace {

using Balls = std::vector<Ball>;
using Shape = std::vector<ComplexBall>;

/// Where no bound could be proven, numbers are told from zero by this share of the largest.
constexpr double unproven = 1e-7;

/// A value of an eigenvalue problem, and what is proven of it.
struct Bounded {
  Ball ball;
  bool proven{};

  [[nodiscard]] std::optional<double> error() const {
    return proven ? std::optional(ball.error()) : std::nullopt;
  }
};

class ModeSearch {
 public:
  explicit ModeSearch(const Linearization& linearization) : at_(linearization) {}

  std::vector<Mode> run() {
    if (at_.reduced.size() > 0 && !(at_.reduced.depends_on_squares() && from_squares())) from_exponents();
    return std::move(modes_);
  }

 private:
  // Without gyroscopic and damping terms.

  bool from_squares() {
    const Eigensystem<Ball> found = squares(at_.reduced);
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
      modes_.insert(modes_.end(), modes.begin(), modes.end());
    }
    return n > 0;
  }

  template <class T>
  [[nodiscard]] Shape shape_of(const Eigensystem<T>& found, std::size_t i) const {
    Shape shape;
    for (std::size_t k = 0; k < at_.reduced.size(); ++k) {
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
    Balls constants = at_.constants;
    for (Ball& c : constants) c.radius += 0x1p-53 * std::abs(c.middle.high);
    const Balls k = evaluated(at_.statics.stiffness, constants, at_.place.x);
    const std::size_t n = at_.reduced.size();
    double moved = 0;
    Ball inertia;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        moved += magnitude(shape[i]) * k[i * n + j].radius * magnitude(shape[j]);
        inertia = inertia + shape[i].re * at_.reduced.mass(i, j) * shape[j].re;
      }
    }
    return moved / std::abs(inertia.middle.high);
  }

  /// No force appears at finite distances along the shape.
  [[nodiscard]] bool is_rigid(const Shape& shape) const {
    double size = 0;
    for (const ComplexBall& entry : shape) size = std::max(size, magnitude(entry.re));
    for (const double distance : {1.0, -0.5}) {
      Balls x = at_.place.x;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] + Ball(distance / size) * shape[i].re;
      const Balls g = evaluated(at_.statics.forces, at_.constants, x);
      if (!std::all_of(g.begin(), g.end(), [](const Ball& force) { return force.contains_zero(); }))
        return false;
    }
    return true;
  }

  // With them.

  void from_exponents() {
    for (const Shape& shape : kernel(at_.reduced.stiffness)) {
      std::vector<Mode> modes(1);
      modes[0].kind = is_rigid(shape) ? ModeKind::rigid : ModeKind::neutral;
      modes[0].omega_error = 0.0;
      set_shapes(modes, {shape}, {});
      modes_.push_back(modes[0]);
    }
    const Eigensystem<ComplexBall> found = exponents(at_.reduced);
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
    if (steady && !swings) return;                            // the kernel of K has it
    if (swings && omega.ball.middle.high < 0) return;         // its conjugate has it
    const bool mirrored = at_.reduced.undamped() && !swings;  // its mirror image has it
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
    modes_.push_back(modes[0]);
  }

  /// Shapes of modes with one s, with the ignored coordinates that move along: their momenta stay, so
  /// M_cc u_c = -(M_cx + D_cx/s) u_x.
  void set_shapes(std::vector<Mode>& modes, const std::vector<Shape>& shapes, const ComplexBall& s) const {
    std::vector<Shape> all;
    for (const Shape& shape : shapes) {
      Shape whole(at_.coordinates);
      for (std::size_t i = 0; i < shape.size(); ++i) whole[at_.statics.reduction.kept[i]] = shape[i];
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
    const std::vector<std::size_t>& ignored = at_.statics.reduction.ignored;
    std::vector<std::vector<ComplexBall>> rows;  // the augmented matrix (M_cc | right-hand side)
    for (const std::size_t c : ignored) {
      rows.emplace_back();
      for (const std::size_t other : ignored) rows.back().emplace_back(at_.whole.mass(c, other));
      ComplexBall sum;
      for (std::size_t i = 0; i < shape.size(); ++i) {
        const std::size_t k = at_.statics.reduction.kept[i];
        sum = sum - at_.whole.mass(c, k) * shape[i];
        const bool turning = magnitude(s) > 0 && !at_.whole.rates(c, k).is_zero();
        if (turning) sum = sum - at_.whole.rates(c, k) * shape[i] / s;
      }
      rows.back().push_back(sum);
    }
    rows = echelon_form(std::move(rows));
    std::vector<std::pair<std::size_t, ComplexBall>> result;
    for (std::size_t k = 0; k < ignored.size(); ++k) result.emplace_back(ignored[k], rows[k].back());
    return result;
  }

  const Linearization& at_;
  std::vector<Mode> modes_;
};

}  // namespace

std::vector<Ball> evaluated(const CompiledFunction& function, const std::vector<Ball>& constants,
                            const std::vector<Ball>& x) {
  Balls out(function.outputs());
  TapeEvaluator<Ball>(function, constants)(x, out);
  return out;
}

std::vector<Mode> modes_of(const Linearization& linearization) { return ModeSearch(linearization).run(); }

}  // namespace qdot
