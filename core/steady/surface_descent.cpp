#include "core/steady/surface_descent.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/numerics/dense_matrix.hpp"
#include "core/steady/comparable_units.hpp"
#include "core/steady/gradient_flow.hpp"

namespace qdot {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_corrections = 8;
/// Of the forces that the multipliers balance: what is below it is rounding.
constexpr double no_force = 1e-14;
/// Of the stiffness: what is below it is rounding.
constexpr double symmetric_on_surface = 1e-12;

class Descent {
 public:
  Descent(const SurfaceStatics& whole, std::span<const double> constants, std::span<const double> start)
      : whole_(whole),
        n_(static_cast<Eigen::Index>(whole.coordinates)),
        m_(static_cast<Eigen::Index>(whole.constraints)),
        forces_(whole.statics->forces.bind(constants)),
        slopes_(whole.statics->stiffness.bind(constants)),
        inertia_(whole.statics->inertia.bind(constants)),
        q_(Eigen::Map<const VectorXd>(start.data(), n_)),
        sizes_(sizes(Eigen::Map<const VectorXd>(start.data(), n_ + m_))) {}

  std::optional<LowestPlace> lowest() {
    if (!back_on_surface()) return std::nullopt;
    const Hillside hillside{
        [this](const VectorXd& q) { return slope(q); },
        [this](const VectorXd& q, const Slope& at, const VectorXd& s) { return moved(q, at, s); }, sizes_};
    const auto low = end_of_flow(hillside, VectorXd(q_));
    if (!low || !slope(*low)) return std::nullopt;  // which writes the multipliers there
    return LowestPlace{place(), {sizes_.begin(), sizes_.end()}};
  }

 private:
  /// An angle is measured by 1, anything else by the largest start of its unit, or if all are 0 by
  /// sizes_at.
  [[nodiscard]] VectorXd sizes(const VectorXd& start) {
    const auto& coordinates = whole_.dynamics->model().scene.coordinates;
    const auto& kept = whole_.statics->reduction.kept;
    const auto unit = [&](Eigen::Index i) { return coordinates[kept[static_cast<std::size_t>(i)]].unit; };
    VectorXd result = sizes_where_zero(start);
    for (Eigen::Index i = 0; i < n_; ++i) {
      double largest = 0;
      for (Eigen::Index k = 0; k < n_; ++k)
        if (unit(k) == unit(i)) largest = std::max(largest, std::abs(q_[k]));
      if (unit(i) != "rad" && largest > 0) result[i] = largest;
    }
    return result;
  }

  [[nodiscard]] VectorXd sizes_where_zero(const VectorXd& start) {
    const VectorXd q = start.head(n_), multipliers = start.tail(m_);
    const std::vector<double> g = values(whole_.statics->forces, forces_, q, multipliers);
    const std::vector<double> k = values(whole_.statics->stiffness, slopes_, q, multipliers);
    const std::vector<double> m = values(whole_.statics->inertia, inertia_, q, multipliers);
    if (g.empty() || k.empty() || m.empty()) return VectorXd::Ones(n_);
    const auto matrix = [&](const std::vector<double>& rows) {
      return MatrixXd(Eigen::Map<const MatrixXd>(rows.data(), n_ + m_, n_ + m_).transpose());
    };
    std::vector<std::string> units;
    for (const std::size_t i : whole_.statics->reduction.kept)
      units.push_back(whole_.dynamics->model().scene.coordinates[i].unit);
    const VectorXd forces = Eigen::Map<const VectorXd>(g.data(), n_ + m_);
    const auto stiffness_at = [&](const VectorXd& x) -> std::optional<MatrixXd> {
      const std::vector<double> there = values(whole_.statics->stiffness, slopes_, x.head(n_), x.tail(m_));
      return there.empty() ? std::nullopt : std::optional(matrix(there));
    };
    return sizes_at({start, forces, matrix(k), matrix(m), stiffness_at}, units).head(n_);
  }

  [[nodiscard]] std::vector<double> place() const {
    std::vector<double> x(q_.begin(), q_.end());
    x.insert(x.end(), multipliers_.begin(), multipliers_.end());
    return x;
  }

  [[nodiscard]] std::vector<double> values(const CompiledFunction& function, Workspace& workspace,
                                           const VectorXd& q, const VectorXd& multipliers) const {
    VectorXd x(n_ + m_);
    x << q, multipliers;
    std::vector<double> out(function.outputs());
    const std::span<const double> at(x.data(), static_cast<std::size_t>(x.size()));
    if (function.evaluate(0, at, workspace, out) != Evaluation::ok) return {};
    return out;
  }

  /// g and phi where the multipliers are zero.
  [[nodiscard]] std::optional<VectorXd> forces(const VectorXd& q) {
    const std::vector<double> out = values(whole_.statics->forces, forces_, q, VectorXd::Zero(m_));
    if (out.empty()) return std::nullopt;
    VectorXd result = Eigen::Map<const VectorXd>(out.data(), n_ + m_);
    result.tail(m_) *= -1;
    return result.allFinite() ? std::optional(result) : std::nullopt;
  }

  /// The stiffness of (q, lambda), displacements and forces in units of the sizes of q.
  [[nodiscard]] std::optional<MatrixXd> stiffness(const VectorXd& multipliers) {
    const std::vector<double> out = values(whole_.statics->stiffness, slopes_, q_, multipliers);
    if (out.empty()) return std::nullopt;
    VectorXd scale = VectorXd::Ones(n_ + m_);
    scale.head(n_) = sizes_;
    MatrixXd k = Eigen::Map<const MatrixXd>(out.data(), n_ + m_, n_ + m_).transpose();  // written by rows
    k = scale.asDiagonal() * k * scale.asDiagonal();
    return k.allFinite() ? std::optional(k) : std::nullopt;
  }

  /// A in units of the sizes.
  [[nodiscard]] std::optional<MatrixXd> slopes() {
    const auto k = stiffness(VectorXd::Zero(m_));
    return k ? std::optional<MatrixXd>(-k->bottomLeftCorner(m_, n_)) : std::nullopt;
  }

  /// A^+, its rows measured by what they are themselves: each constraint has a unit of its own.
  [[nodiscard]] static MatrixXd inverse_of_slopes(const MatrixXd& a) {
    const VectorXd sizes = a.rowwise().norm();
    const VectorXd units = (sizes.array() > 0).select(sizes.cwiseInverse(), 1);
    return pseudo_inverse(units.asDiagonal() * a) * units.asDiagonal();
  }

  /// A displacement dq = A^+ A dq + (what the constraints allow), in units of the sizes.
  [[nodiscard]] MatrixXd allowed(const MatrixXd& a) const {
    return MatrixXd::Identity(n_, n_) - inverse_of_slopes(a) * a;
  }

  /// Independent displacements that the constraints allow; the others have the value 0.
  [[nodiscard]] std::optional<MatrixXd> tangents(const MatrixXd& a) const {
    const MatrixXd onto = allowed(a), units = MatrixXd::Identity(n_, n_);
    const auto axes = principal_axes(onto, units);
    return axes ? std::optional<MatrixXd>(axes->vectors.rightCols(n_ - m_)) : std::nullopt;
  }

  /// In units of the sizes.
  [[nodiscard]] std::optional<MatrixXd> inertia() {
    const std::vector<double> out = values(whole_.statics->inertia, inertia_, q_, VectorXd::Zero(m_));
    if (out.empty()) return std::nullopt;
    const MatrixXd m = Eigen::Map<const MatrixXd>(out.data(), n_ + m_, n_ + m_).topLeftCorner(n_, n_);
    return sizes_.asDiagonal() * m * sizes_.asDiagonal();
  }

  /// Writes the multipliers that leave the least force.
  [[nodiscard]] std::optional<Slope> slope(const VectorXd& q) {
    q_ = q;
    const auto g = forces(q_);
    const auto a = slopes();
    const auto m = inertia();
    if (!g || !a || !m) return std::nullopt;
    const VectorXd force = sizes_.cwiseProduct(g->head(n_));
    multipliers_ = inverse_of_slopes(*a).transpose() * force;
    if (!multipliers_.allFinite()) return std::nullopt;
    const auto k = stiffness(multipliers_);
    const auto z = tangents(*a);
    if (!k || !z) return std::nullopt;
    const MatrixXd along = z->transpose() * k->topLeftCorner(n_, n_) * *z;
    const MatrixXd curvature = (along + along.transpose()) / 2, mass = z->transpose() * *m * *z;
    const auto axes = principal_axes(curvature, mass);
    if (!axes) return std::nullopt;
    const MatrixXd displacements = *z * axes->vectors;
    VectorXd left = displacements.transpose() * force;
    if (!((z->transpose() * force).norm() > no_force * force.norm())) left.setZero();
    const bool is_gradient = (along - along.transpose()).norm() <= symmetric_on_surface * along.norm();
    return Slope{axes->values, left, sizes_.asDiagonal() * displacements, is_gradient};
  }

  /// Brought back onto the surface, with what that makes of the axes there.
  [[nodiscard]] std::optional<Moved> moved(const VectorXd& q, const Slope& at, const VectorXd& s) {
    q_ = q + at.axes * s;
    if (!back_on_surface() || !in_domain()) return std::nullopt;
    const auto g = forces(q_);
    const auto a = slopes();
    const auto m = inertia();
    if (!g || !a || !m) return std::nullopt;
    const MatrixXd axes = allowed(*a) * sizes_.cwiseInverse().asDiagonal() * at.axes;
    const VectorXd force = axes.transpose() * sizes_.cwiseProduct(g->head(n_));
    return Moved{q_, solve(axes.transpose() * *m * axes, force)};
  }

  [[nodiscard]] bool in_domain() const {
    const auto& coordinates = whole_.dynamics->model().scene.coordinates;
    for (Eigen::Index i = 0; i < n_; ++i)
      if (!coordinates[whole_.statics->reduction.kept[static_cast<std::size_t>(i)]].domain.contains(q_[i]))
        return false;
    return true;
  }

  /// By Newton's iteration with the shortest steps.
  [[nodiscard]] bool back_on_surface() {
    for (int i = 0; i < most_corrections; ++i) {
      const auto g = forces(q_);
      const auto a = slopes();
      if (!g || !a) return false;
      const VectorXd step = inverse_of_slopes(*a) * g->tail(m_);
      q_ -= sizes_.cwiseProduct(step);
      if (step.norm() < 1e-9) return true;
    }
    return false;
  }

  const SurfaceStatics& whole_;
  Eigen::Index n_, m_;
  Workspace forces_, slopes_, inertia_;
  VectorXd q_, sizes_, multipliers_;
};

}  // namespace

std::optional<LowestPlace> lowest_downhill(const SurfaceStatics& whole, std::span<const double> constants,
                                           std::span<const double> start) {
  return Descent(whole, constants, start).lowest();
}

}  // namespace qdot
