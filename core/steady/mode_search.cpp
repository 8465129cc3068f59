#include "core/steady/mode_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/numerics/same_bits.hpp"
#include "core/steady/free_direction.hpp"
#include "core/steady/mode_shapes.hpp"
#include "core/steady/spectrum.hpp"

namespace qdot {
namespace {

/// A value of an eigenvalue problem, and what is proven of it.
struct Bounded {
  Ball ball;
  bool proven{};

  [[nodiscard]] std::optional<double> error() const {
    return proven ? std::optional(ball.error()) : std::nullopt;
  }
};

ComplexBall disc_of(const Exponent& e) {
  ComplexBall s = e.middle;
  s.re.radius = s.im.radius = e.radius;
  return s;
}

constexpr const char* coincide =
    "Eigenvalues of the small motions coincide to within rounding, and no bound of any of them could be proven.";
constexpr const char* no_bound =
    "No bound of an eigenvalue of the small motions could be proven: entries of the mass matrix are too small or "
    "too large for it.";

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

  // Without gyroscopic and damping terms.

  /// False where no bound is to be had this way.
  bool from_squares() {
    const Eigensystem<Ball> found = squares(at_.reduced);
    if (!std::ranges::all_of(found.radii, [](double r) { return std::isfinite(r); })) return false;
    const std::vector<std::vector<std::size_t>> groups = groups_of(found);
    if (!std::ranges::all_of(groups, [&](const auto& members) { return has_all_shapes(found, members); }))
      return false;
    for (const std::vector<std::size_t>& members : groups) {
      std::vector<Shape> shapes;
      for (const std::size_t i : members) shapes.push_back(shape_of(found, i));
      const std::vector<Mode> modes = modes_of_square(found, members, shapes);
      modes_.insert(modes_.end(), modes.begin(), modes.end());
    }
    return !groups.empty();
  }

  /// Those that cannot be told apart.
  [[nodiscard]] static std::vector<std::vector<std::size_t>> groups_of(const Eigensystem<Ball>& found) {
    const std::size_t n = found.values.size();
    std::vector<std::vector<std::size_t>> groups(n);
    for (std::size_t i = 0; i < n; ++i) groups[found.group[i]].push_back(i);
    std::erase_if(groups, [](const auto& members) { return members.empty(); });
    return groups;
  }

  /// As many as the group has members: surely where a potential is beside a kinetic energy of one sign; what
  /// drives another at its own frequency lacks some.
  [[nodiscard]] bool has_all_shapes(const Eigensystem<Ball>& found,
                                    const std::vector<std::size_t>& members) const {
    if (members.size() == 1 || (at_.reduced.undamped() && has_one_sign(at_.reduced.mass))) return true;
    const Ball lambda(found.values[members[0]].middle, found.radii[members[0]]);
    SquareMatrix<Ball> rest = at_.reduced.stiffness;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      for (std::size_t j = 0; j < rest.size(); ++j) rest(i, j) = rest(i, j) - lambda * at_.reduced.mass(i, j);
    }
    return kernel(rest).size() >= members.size();
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
                                                  std::vector<Shape> shapes) const {
    const bool vanish = std::ranges::all_of(members, [&](std::size_t i) { return is_near_zero(found, i); });
    const std::size_t symmetric = vanish ? put_symmetric_first(shapes) : 0;
    std::vector<Mode> modes;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t i = members[k];
      const bool proven = std::isfinite(found.radii[i]);
      const Ball lambda(found.values[i].middle, proven ? found.radii[i] : 0);
      modes.push_back(mode_of_square({lambda, proven}, shapes[k], k < symmetric));
      modes.back().multiplicity = members.size();
    }
    ComplexBall s;  // only its ratio to the ignored coordinates' momenta matters, and all members share it
    const Ball first = found.values[members[0]];
    (first.middle.high < 0 ? s.re : s.im) =
        modes[0].omega == 0 && modes[0].rate == 0 ? Ball(0) : sqrt(first.middle.high < 0 ? -first : first);
    set_shapes_apart(modes, shapes, symmetric, s);
    return modes;
  }

  [[nodiscard]] static bool is_near_zero(const Eigensystem<Ball>& found, std::size_t i) {
    return Ball(found.values[i].middle, found.radii[i]).contains_zero();
  }

  [[nodiscard]] bool is_rigid(const Shape& shape) const {
    return is_free(at_.statics, at_.constants, displaced(at_, shape));
  }

  /// Of several shapes that vanish any combinations are found: brings those along the place's family to the
  /// front, and says how many. Free directions are among the shortest combinations of the others.
  [[nodiscard]] std::size_t put_symmetric_first(std::vector<Shape>& shapes) const {
    const std::vector<Shape> family = echelon_form(directions_of_family(at_));
    if (family.empty()) {
      if (shapes.size() > 1) shapes = echelon_form(std::move(shapes));
      return 0;
    }
    std::vector<Shape> others = echelon_form(without(family, std::move(shapes)));
    shapes = family;
    shapes.insert(shapes.end(), others.begin(), others.end());
    return family.size();
  }

  /// Those along the family are combined with each other alone.
  void set_shapes_apart(std::vector<Mode>& modes, const std::vector<Shape>& shapes, std::size_t symmetric,
                        const ComplexBall& s) const {
    const std::size_t first = std::min(symmetric, modes.size());
    for (const auto& [begin, end] : {std::pair<std::size_t, std::size_t>{0, first}, {first, modes.size()}}) {
      const auto from = static_cast<std::ptrdiff_t>(begin), to = static_cast<std::ptrdiff_t>(end);
      std::vector<Mode> part(modes.begin() + from, modes.begin() + to);
      set_shapes(at_, part, {shapes.begin() + from, shapes.begin() + to}, s);
      std::ranges::move(part, modes.begin() + from);
    }
  }

  [[nodiscard]] Mode mode_of_square(const Bounded& lambda, const Shape& shape, bool is_symmetric) const {
    Mode mode;
    const double rounding = rounding_of_parameters(at_, shape);
    if (lambda.ball.contains_zero() || std::abs(lambda.ball.value()) <= rounding) {
      const bool rigid = is_symmetric || (lambda.ball.contains_zero() && is_rigid(shape));
      mode.kind = rigid ? ModeKind::rigid : ModeKind::neutral;
      mode.lambda = 0.0;
      mode.omega_error = rigid ? 0 : std::sqrt(std::max(lambda.ball.magnitude(), rounding));
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

  // With them.

  void from_exponents() {
    std::vector<Shape> shapes = kernel(at_.reduced.stiffness);
    const std::size_t count = shapes.size(), symmetric = put_symmetric_first(shapes);
    shapes.resize(count);
    // Eigenvalues that the kernel of K answers for.
    const std::size_t zeros = count + undamped_among(at_.reduced, shapes);
    for (std::size_t k = 0; k < count; ++k) {
      const Shape& shape = shapes[k];
      std::vector<Mode> modes(1);
      modes[0].kind = k < symmetric || is_rigid(shape) ? ModeKind::rigid : ModeKind::neutral;
      set_shapes(at_, modes, {shape}, {});
      if (modes[0].kind == ModeKind::rigid || is_zero(at_.reduced.stiffness)) {
        modes[0].omega_error = 0.0;
      } else {
        nearly_zero_.push_back(modes_.size());
      }
      modes_.push_back(modes[0]);
    }
    const Eigensystem<ComplexBall> vectors = exponents(at_.reduced);
    if (std::ranges::all_of(vectors.radii, [](double r) { return std::isfinite(r); })) {
      from_eigenvectors(vectors, zeros);
    } else {
      from_clusters(vectors, zeros);
    }
  }

  /// Eigenvalues with eigenvectors of their own, or groups that rounding makes one.
  void from_eigenvectors(const Eigensystem<ComplexBall>& found, std::size_t zeros) {
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      const auto members =
          static_cast<std::size_t>(std::count(found.group.begin(), found.group.end(), found.group[i]));
      const bool near_axis = Ball(found.values[i].re.middle, found.radii[i]).contains_zero();
      const bool on_axis =
          near_axis && at_.reduced.undamped() && (members == 1 || held_by_potential(at_.reduced));
      Exponent e{found.values[i], found.radii[i], members, on_axis};
      const Shape shape = shape_of(found, i);
      e.undamped = on_axis || (near_axis && is_undamped(e, shape, found.values, found.radii));
      add_exponent(e, members > 1 ? shapes_of_group(e, shape) : std::vector<Shape>{shape}, zeros);
    }
  }

  /// Where a group has fewer shapes than members, vectors that were found apart are so by rounding alone.
  [[nodiscard]] std::vector<Shape> shapes_of_group(const Exponent& e, const Shape& own) const {
    std::vector<Shape> shapes = kernel(dynamic_stiffness(at_.reduced, disc_of(e)));
    const bool lacks_some = !shapes.empty() && shapes.size() < e.members;
    return lacks_some ? shapes : std::vector<Shape>{own};
  }

  /// Damping leaves the motion along the shape alone: a single eigenvalue i sqrt(lambda) in the disc and in
  /// none of the others.
  [[nodiscard]] bool is_undamped(const Exponent& e, const Shape& shape,
                                 const std::vector<ComplexBall>& centres,
                                 const std::vector<double>& radii) const {
    if (e.members > 1 || !(e.middle.im.middle.high > e.radius)) return false;
    const std::optional<Ball> lambda = undamped_along(at_, shape);
    if (!lambda || !(lambda->middle.high > lambda->radius)) return false;
    const ComplexBall s(Ball(0), sqrt(*lambda));
    const auto may_hold_it = [&](const ComplexBall& centre, double radius) {
      const ComplexBall apart = s - centre;
      return hypotenuse(apart.re.value(), apart.im.value()) * (1 - 0x1p-30) <=
             radius + apart.re.error() + apart.im.error();
    };
    std::size_t holding = 0;
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (may_hold_it(centres[i], radii[i])) ++holding;
    return holding == 1 && may_hold_it(e.middle, e.radius);
  }

  /// Eigenvalues that may lack eigenvectors: their shapes are those that make s^2 M + s D + K vanish.
  void from_clusters(const Eigensystem<ComplexBall>& vectors, std::size_t zeros) {
    const std::vector<Exponent> all = spectrum(at_.reduced);
    std::vector<ComplexBall> centres;
    std::vector<double> radii;
    for (const Exponent& e : all) {
      centres.push_back(e.middle);
      radii.push_back(e.radius);
    }
    for (Exponent e : all) {
      if (!std::isfinite(e.radius)) {
        throw Error(ErrorCode::not_applicable, at_.reduced.size() > 1 ? coincide : no_bound);
      }
      e.undamped = e.undamped || (at_.reduced.undamped() && held_by_potential(at_.reduced));
      std::vector<Shape> shapes = kernel(dynamic_stiffness(at_.reduced, disc_of(e)));
      const bool found = !shapes.empty() && shapes.size() <= e.members;
      if (!found) shapes = {nearest_vector(vectors, e)};
      const bool near_axis = Ball(e.middle.re.middle, e.radius).contains_zero();
      e.undamped = e.undamped || (near_axis && is_undamped(e, shapes[0], centres, radii));
      const std::size_t before = modes_.size();
      add_exponent(e, shapes, zeros);
      if (!found && modes_.size() > before) modes_.back().shape_error.clear();
    }
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

  /// What vanishes to within rounding, or within the width of the place, is known as its eigenvalue is.
  void widen_zeros(double s) {
    for (const std::size_t k : nearly_zero_) {
      std::optional<double>& error = modes_[k].omega_error;
      error = std::max(error.value_or(0), s);
    }
  }

  [[nodiscard]] static bool is_zero(const SquareMatrix<Ball>& k) {
    for (std::size_t i = 0; i < k.size(); ++i) {
      for (std::size_t j = 0; j < k.size(); ++j)
        if (!k(i, j).is_zero()) return false;
    }
    return true;
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
      if (near_zero_++ < zeros) return widen_zeros(magnitude(e.middle) + e.radius);
      if (mirrored && near_zero_ % 2 == 0) return;
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
    set_shapes(at_, modes, {shapes[place]}, e.middle);
    modes_.push_back(modes[0]);
  }

  const Linearization& at_;
  std::vector<Mode> modes_;
  std::vector<std::size_t> nearly_zero_;  ///< modes whose stiffness is zero as far as it is known
  std::size_t near_zero_{};               ///< eigenvalues that may be zero, so far
  std::size_t shape_in_disc_{};           ///< members of the present disc, so far
};

}  // namespace

std::vector<Mode> modes_of(const Linearization& linearization) { return ModeSearch(linearization).run(); }

}  // namespace qdot
