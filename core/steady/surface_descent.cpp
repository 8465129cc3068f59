#include "core/steady/surface_descent.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_places = 100;
constexpr int most_corrections = 8;
constexpr double step_length = 0.1;

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

  std::vector<std::vector<double>> run() {
    std::vector<std::vector<double>> places;
    std::optional<VectorXd> way = downhill();
    for (int i = 0; way && i < most_places; ++i) {
      q_ += step_length * sizes_.cwiseProduct(*way);
      if (!back_on_surface()) break;
      const std::optional<VectorXd> next = downhill();
      if (!next || !multipliers_.allFinite()) break;
      places.emplace_back(q_.begin(), q_.end());
      places.back().insert(places.back().end(), multipliers_.begin(), multipliers_.end());
      if (!(next->dot(*way) > 0)) break;
      way = next;
    }
    return places;
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

  [[nodiscard]] std::vector<double> values(const CompiledFunction& function, Workspace& workspace) const {
    VectorXd x = VectorXd::Zero(n_ + m_);
    x.head(n_) = q_;
    std::vector<double> out(function.outputs());
    const std::span<const double> at(x.data(), static_cast<std::size_t>(x.size()));
    if (function.evaluate(0, at, workspace, out) != Evaluation::ok) return {};
    return out;
  }

  /// g and phi where the multipliers are zero.
  [[nodiscard]] std::optional<VectorXd> forces() {
    const std::vector<double> out = values(whole_.statics->forces, forces_);
    if (out.empty()) return std::nullopt;
    VectorXd result = Eigen::Map<const VectorXd>(out.data(), n_ + m_);
    result.tail(m_) *= -1;
    return result.allFinite() ? std::optional(result) : std::nullopt;
  }

  /// A in units of the sizes.
  [[nodiscard]] std::optional<MatrixXd> slopes() {
    const std::vector<double> out = values(whole_.statics->stiffness, slopes_);
    if (out.empty()) return std::nullopt;
    MatrixXd a(m_, n_);
    for (Eigen::Index j = 0; j < m_; ++j) {
      for (Eigen::Index i = 0; i < n_; ++i)
        a(j, i) = -out[static_cast<std::size_t>((n_ + j) * (n_ + m_) + i)] * sizes_[i];
    }
    return a.allFinite() ? std::optional(a) : std::nullopt;
  }

  /// The direction in units of the sizes; writes the multipliers that leave the least force.
  [[nodiscard]] std::optional<VectorXd> downhill() {
    const auto g = forces();
    const auto a = slopes();
    if (!g || !a) return std::nullopt;
    const VectorXd slope = sizes_.cwiseProduct(g->head(n_));
    multipliers_ = pseudo_inverse(a->transpose()) * slope;
    const VectorXd along = a->transpose() * multipliers_ - slope;
    const double length = along.norm();
    return length > 0 ? std::optional<VectorXd>(along / length) : std::nullopt;
  }

  /// By Newton's iteration with the shortest steps.
  [[nodiscard]] bool back_on_surface() {
    for (int i = 0; i < most_corrections; ++i) {
      const auto g = forces();
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

std::vector<std::vector<double>> places_downhill(const SurfaceStatics& whole,
                                                 std::span<const double> constants,
                                                 std::span<const double> start) {
  return Descent(whole, constants, start).run();
}

}  // namespace qdot
