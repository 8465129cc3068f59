#include "core/steady/mode_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/compile/tape_evaluator.hpp"
#include "core/steady/inertia.hpp"
#include "core/steady/spectrum.hpp"

namespace qdot {
namespace {

using Balls = std::vector<Ball>;
using Shape = std::vector<ComplexBall>;

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
    add_rigid();
    if (at_.reduced.size() > 0 && !(at_.reduced.depends_on_squares() && from_squares())) from_exponents();
    put_in_order();
    return std::move(modes_);
  }

 private:
  void add_rigid() {
    for (const std::size_t c : at_.statics.reduction.ignored) {
      Mode rigid;
      rigid.kind = ModeKind::rigid;
      rigid.omega_error = rigid.lambda = 0.0;
      rigid.shape.assign(at_.coordinates, 0.0);
      rigid.shape[c] = 1;
      modes_.push_back(std::move(rigid));
    }
  }

  void put_in_order() {
    std::ranges::stable_sort(modes_, [](const Mode& a, const Mode& b) {
      if (a.omega != b.omega) return a.omega < b.omega;
      return a.kind != b.kind ? a.kind < b.kind : a.rate > b.rate;
    });
    const auto is_rigid = [](const Mode& mode) { return mode.kind == ModeKind::rigid; };
    const auto rigid = static_cast<std::size_t>(std::ranges::count_if(modes_, is_rigid));
    for (Mode& mode : modes_) {
      if (mode.kind == ModeKind::rigid) mode.multiplicity = rigid;
    }
  }

  /// u of the kept coordinates.
  [[nodiscard]] Shape displaced(const Shape& v) const {
    if (at_.allowed.empty()) return v;
    Shape u;
    for (const std::vector<Ball>& row : at_.allowed) {
      u.emplace_back();
      for (std::size_t f = 0; f < v.size(); ++f) u.back() = u.back() + ComplexBall(row[f]) * v[f];
    }
    return u;
  }

  // Without gyroscopic and damping terms.

  /// False where no bound is to be had this way.
  bool from_squares() {
    const Eigensystem<Ball> found = squares(at_.reduced);
    const std::size_t n = found.values.size();
    if (!std::ranges::all_of(found.radii, [](double r) { return std::isfinite(r); })) return false;
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
    const Shape u = displaced(shape);
    double moved = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      for (std::size_t j = 0; j < u.size(); ++j)
        moved += magnitude(u[i]) * k[i * at_.place.x.size() + j].radius * magnitude(u[j]);
    }
    Ball inertia;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      for (std::size_t j = 0; j < shape.size(); ++j)
        inertia = inertia + shape[i].re * at_.reduced.mass(i, j) * shape[j].re;
    }
    return moved / std::abs(inertia.middle.high);
  }

  /// No force appears at finite distances along the shape, which leaves no surface.
  [[nodiscard]] bool is_rigid(const Shape& of_reduced) const {
    const Shape shape = displaced(of_reduced);
    double size = 0;
    for (const ComplexBall& entry : shape) size = std::max(size, magnitude(entry.re));
    for (const double distance : {1.0, -0.5}) {
      Balls x = at_.place.x;
      for (std::size_t i = 0; i < shape.size(); ++i) x[i] = x[i] + Ball(distance / size) * shape[i].re;
      const Balls g = evaluated(at_.statics.forces, at_.constants, x);
      if (!std::all_of(g.begin(), g.end(), [](const Ball& force) { return force.contains_zero(); }))
        return false;
    }
    return true;
  }

  // With them.

  void from_exponents() {
    std::size_t zeros = 0;  // eigenvalues that the kernel of K answers for
    for (const Shape& shape : kernel(at_.reduced.stiffness)) {
      std::vector<Mode> modes(1);
      modes[0].kind = is_rigid(shape) ? ModeKind::rigid : ModeKind::neutral;
      modes[0].omega_error = 0.0;
      set_shapes(modes, {shape}, {});
      modes_.push_back(modes[0]);
      zeros += is_undamped_along(shape) ? 2 : 1;
    }
    const Eigensystem<ComplexBall> vectors = exponents(at_.reduced);
    if (std::ranges::all_of(vectors.radii, [](double r) { return std::isfinite(r); })) {
      from_eigenvectors(vectors, zeros);
    } else {
      from_clusters(vectors, zeros);
    }
  }

  /// D v = 0, so that u = v t is a motion, too, and s = 0 counts twice.
  [[nodiscard]] bool is_undamped_along(const Shape& v) const {
    for (std::size_t i = 0; i < v.size(); ++i) {
      ComplexBall sum;
      for (std::size_t j = 0; j < v.size(); ++j) sum = sum + ComplexBall(at_.reduced.rates(i, j)) * v[j];
      if (!sum.re.contains_zero() || !sum.im.contains_zero()) return at_.reduced.undamped();
    }
    return true;
  }

  /// Eigenvalues with eigenvectors of their own, or groups that rounding makes one.
  void from_eigenvectors(const Eigensystem<ComplexBall>& found, std::size_t zeros) {
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      const auto members =
          static_cast<std::size_t>(std::count(found.group.begin(), found.group.end(), found.group[i]));
      const bool near_axis = Ball(found.values[i].re.middle, found.radii[i]).contains_zero();
      const bool on_axis = near_axis && at_.reduced.undamped() && (members == 1 || held_by_potential());
      add_exponent({found.values[i], found.radii[i], members, on_axis}, {shape_of(found, i)}, zeros);
    }
  }

  /// Eigenvalues that may lack eigenvectors: their shapes are those that make s^2 M + s D + K vanish.
  void from_clusters(const Eigensystem<ComplexBall>& vectors, std::size_t zeros) {
    for (Exponent e : spectrum(at_.reduced)) {
      if (!std::isfinite(e.radius)) {
        throw Error(ErrorCode::not_applicable,
                    "Eigenvalues of the small motions coincide to within rounding, and no bound of any of "
                    "them could be proven.");
      }
      e.undamped = e.undamped || (at_.reduced.undamped() && held_by_potential());
      std::vector<Shape> shapes = kernel(dynamic_stiffness(e));
      const bool found = !shapes.empty() && shapes.size() <= e.members;
      if (!found) shapes = {nearest_vector(vectors, e)};
      const std::size_t before = modes_.size();
      add_exponent(e, shapes, zeros);
      if (!found && modes_.size() > before) modes_.back().shape_error.clear();
    }
  }

  /// K is positive definite: without damping nothing can grow.
  [[nodiscard]] bool held_by_potential() const {
    const std::size_t n = at_.reduced.size();
    std::vector<Interval> stiffness;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const Ball& k = at_.reduced.stiffness(i, j);
        stiffness.emplace_back(k.value() - k.error(), k.value() + k.error());
      }
    }
    return inertia_of(stiffness, n).positive == n;
  }

  /// s^2 M + s D + K.
  [[nodiscard]] SquareMatrix<ComplexBall> dynamic_stiffness(const Exponent& e) const {
    ComplexBall s = e.middle;
    s.re.radius = s.im.radius = e.radius;
    const std::size_t n = at_.reduced.size();
    SquareMatrix<ComplexBall> result(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        result(i, j) = s * s * ComplexBall(at_.reduced.mass(i, j)) +
                       s * ComplexBall(at_.reduced.rates(i, j)) + ComplexBall(at_.reduced.stiffness(i, j));
      }
    }
    return result;
  }

  [[nodiscard]] Shape nearest_vector(const Eigensystem<ComplexBall>& vectors, const Exponent& e) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < vectors.values.size(); ++i) {
      const bool nearer =
          magnitude(vectors.values[i] - e.middle) < magnitude(vectors.values[best] - e.middle);
      if (nearer) best = i;
    }
    Shape shape;
    for (std::size_t k = 0; k < at_.reduced.size(); ++k) shape.push_back(middle_of(vectors.vectors(k, best)));
    return shape;
  }

  /// `zeros` eigenvalues zero belong to modes that are there already. Members of one disc come one by one,
  /// and share its shapes.
  void add_exponent(const Exponent& e, const std::vector<Shape>& shapes, std::size_t zeros) {
    const Ball rate(e.undamped ? DoubleDouble{} : e.middle.re.middle, e.undamped ? 0 : e.radius);
    const Ball omega(e.middle.im.middle, e.radius);
    const bool steady = rate.contains_zero();
    const bool swings = !omega.contains_zero();
    if (swings && omega.middle.high < 0) return;              // its conjugate has it
    const bool mirrored = at_.reduced.undamped() && !swings;  // its mirror image has it
    if (mirrored && !steady && rate.middle.high < 0) return;
    Mode mode;
    mode.multiplicity = e.members;
    if (steady && !swings) {
      if (near_zero_++ < zeros || (mirrored && near_zero_ % 2 == 0)) return;
      mode.kind = ModeKind::neutral;
      mode.omega_error = magnitude(e.middle) + e.radius;
    } else {
      mode.kind = steady ? ModeKind::oscillation : rate.middle.high > 0 ? ModeKind::growth : ModeKind::decay;
      mode.omega = swings ? omega.value() : 0;
      mode.rate = steady ? 0 : std::abs(rate.value());
      if (swings) mode.omega_error = omega.error();
      if (!steady || !e.undamped) mode.rate_error = steady ? rate.magnitude() : rate.error();
      if ((steady && e.undamped) || mirrored)
        mode.lambda = steady ? mode.omega * mode.omega : -mode.rate * mode.rate;
    }
    const std::size_t place = shape_in_disc_ % shapes.size();
    shape_in_disc_ = e.members > 1 ? shape_in_disc_ + 1 : 0;
    std::vector<Mode> modes{mode};
    set_shapes(modes, {shapes[place]}, e.middle);
    modes_.push_back(modes[0]);
  }

  /// Shapes of modes with one s, with the ignored coordinates that move along: their momenta stay, so
  /// M_cc u_c = -(M_cx + D_cx/s) u_x.
  void set_shapes(std::vector<Mode>& modes, const std::vector<Shape>& shapes, const ComplexBall& s) const {
    std::vector<Shape> all;
    for (const Shape& of_reduced : shapes) {
      const Shape shape = displaced(of_reduced);
      Shape whole(at_.coordinates);
      for (std::size_t i = 0; i < shape.size(); ++i) whole[at_.statics.reduction.kept[i]] = shape[i];
      for (auto& [c, value] : companions(shape, s)) whole[c] = value;
      all.push_back(std::move(whole));
    }
    all = echelon_form(std::move(all));
    for (std::size_t k = 0; k < modes.size(); ++k) {
      modes[k].shape.clear();
      for (const ComplexBall& entry : all[k]) modes[k].shape.emplace_back(entry.re.value(), entry.im.value());
      if (modes[k].multiplicity == 1) modes[k].shape_error = errors_of(all[k]);
    }
  }

  /// None where the shape is not enclosed.
  [[nodiscard]] static std::vector<double> errors_of(const Shape& shape) {
    std::vector<double> errors;
    for (const ComplexBall& entry : shape) {
      errors.push_back(entry.re.error() + entry.im.error());
      if (!std::isfinite(errors.back())) return {};
    }
    return errors;
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
  std::size_t near_zero_{};      ///< eigenvalues that may be zero, so far
  std::size_t shape_in_disc_{};  ///< members of the present disc, so far
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
