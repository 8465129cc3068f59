#include "core/steady/surface_descent.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_steps_down = 200;
constexpr int most_corrections = 8;
/// In units of the coordinates' sizes.
constexpr double longest_step = 0.5;
constexpr double least_part = 1e-4;
constexpr double too_short = 1e-12;
/// Of the forces that the multipliers balance: what is below it is rounding.
constexpr double no_force = 1e-14;

class Descent {
 public:
  Descent(const SurfaceStatics& whole, std::span<const double> constants, std::span<const double> start)
      : whole_(whole),
        n_(static_cast<Eigen::Index>(whole.coordinates)),
        m_(static_cast<Eigen::Index>(whole.constraints)),
        forces_(whole.statics->forces.bind(constants)),
        slopes_(whole.statics->stiffness.bind(constants)),
        q_(Eigen::Map<const VectorXd>(start.data(), n_)),
        sizes_(sizes()) {}

  std::optional<std::vector<double>> lowest() {
    if (!back_on_surface()) return std::nullopt;
    for (int i = 0; i < most_steps_down; ++i) {
      const auto step = downhill();
      if (!step) return std::nullopt;
      if (!(step->norm() > too_short) || !goes_down(*step)) return place();
    }
    return std::nullopt;
  }

 private:
  /// An angle is measured by 1, anything else by the largest start of its unit.
  [[nodiscard]] VectorXd sizes() const {
    const auto& coordinates = whole_.dynamics->model().scene.coordinates;
    const auto& kept = whole_.statics->reduction.kept;
    const auto unit = [&](Eigen::Index i) { return coordinates[kept[static_cast<std::size_t>(i)]].unit; };
    VectorXd result = VectorXd::Ones(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      double largest = 0;
      for (Eigen::Index k = 0; k < n_; ++k)
        if (unit(k) == unit(i)) largest = std::max(largest, std::abs(q_[k]));
      if (unit(i) != "rad" && largest > 0) result[i] = largest;
    }
    return result;
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

  /// -|K|^-1 g along the surface, in units of the sizes; zero where nothing acts along it. Writes the
  /// multipliers that leave the least force.
  [[nodiscard]] std::optional<VectorXd> downhill() {
    const auto g = forces(q_);
    const auto a = slopes();
    if (!g || !a) return std::nullopt;
    const VectorXd slope = sizes_.cwiseProduct(g->head(n_));
    const MatrixXd back = pseudo_inverse(*a);
    multipliers_ = back.transpose() * slope;
    const VectorXd along = slope - a->transpose() * multipliers_;
    if (!multipliers_.allFinite()) return std::nullopt;
    if (!(along.norm() > no_force * slope.norm())) return VectorXd::Zero(n_);
    return shortened(along, MatrixXd::Identity(n_, n_) - back * *a);
  }

  /// `onto` is the projection onto the displacements that the constraints allow.
  [[nodiscard]] std::optional<VectorXd> shortened(const VectorXd& along, const MatrixXd& onto) {
    const auto k = stiffness(multipliers_);
    if (!k) return std::nullopt;
    const MatrixXd of_q = k->topLeftCorner(n_, n_);
    const MatrixXd curvature = onto * (of_q + of_q.transpose()) * onto / 2;
    const MatrixXd units = MatrixXd::Identity(n_, n_);
    const auto axes = principal_axes(curvature, units);
    if (!axes) return std::nullopt;
    VectorXd step = VectorXd::Zero(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      const VectorXd v = onto * axes->vectors.col(i);
      const double force = v.dot(along);
      if (force == 0) continue;
      const double rate = std::max(std::abs(axes->values[i]), std::abs(force) * 1e-8);
      VectorXd part = -force / rate * v;
      if (const double size = part.norm(); size > longest_step) part *= longest_step / size;
      step += part;
    }
    return step;
  }

  /// Takes as much of the step as does work, brought back onto the surface.
  [[nodiscard]] bool goes_down(const VectorXd& step) {
    const VectorXd from = q_;
    for (double t = 1; t > least_part; t /= 2) {
      q_ = from + t * sizes_.cwiseProduct(step);
      if (back_on_surface() && work(from, q_) < 0) return true;
    }
    q_ = from;
    return false;
  }

  /// Simpson's rule for the integral of g along the chord.
  [[nodiscard]] double work(const VectorXd& from, const VectorXd& to) {
    const auto start = forces(from), middle = forces((from + to) / 2), end = forces(to);
    if (!start || !middle || !end) return std::nan("");
    return (to - from).dot((*start + 4 * *middle + *end).head(n_)) / 6;
  }

  /// By Newton's iteration with the shortest steps.
  [[nodiscard]] bool back_on_surface() {
    for (int i = 0; i < most_corrections; ++i) {
      const auto g = forces(q_);
      const auto a = slopes();
      if (!g || !a) return false;
      const VectorXd step = pseudo_inverse(*a) * g->tail(m_);
      q_ -= sizes_.cwiseProduct(step);
      if (step.norm() < 1e-9) return true;
    }
    return false;
  }

  const SurfaceStatics& whole_;
  Eigen::Index n_, m_;
  Workspace forces_, slopes_;
  VectorXd q_, sizes_, multipliers_;
};

}  // namespace

std::optional<std::vector<double>> lowest_downhill(const SurfaceStatics& whole,
                                                   std::span<const double> constants,
                                                   std::span<const double> start) {
  return Descent(whole, constants, start).lowest();
}

}  // namespace qdot
