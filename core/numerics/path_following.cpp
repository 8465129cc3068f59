#include "core/numerics/path_following.hpp"

#include <algorithm>

#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// dF/dx with the direction below it.
MatrixXd bordered(const MatrixXd& derivative, const VectorXd& direction) {
  MatrixXd result(direction.size(), direction.size());
  result << derivative, direction.transpose();
  return result;
}

}  // namespace

VectorXd correction_across(const VectorXd& direction, const MatrixXd& derivative, const VectorXd& residual) {
  VectorXd right = VectorXd::Zero(direction.size());
  right.head(residual.size()) = -residual;
  return solve(bordered(derivative, direction), right);
}

VectorXd tangent_towards(const VectorXd& direction, const MatrixXd& derivative) {
  const Index n = derivative.rows();
  return solve(bordered(derivative, direction), VectorXd::Unit(n + 1, n)).normalized();
}

double distance_to_piece(const VectorXd& begin, const VectorXd& end) {
  const VectorXd chord = end - begin;
  const double share = std::clamp(-begin.dot(chord) / chord.squaredNorm(), 0.0, 1.0);
  return (begin + share * chord).norm();
}

}  // namespace qdot
