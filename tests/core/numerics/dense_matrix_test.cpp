// Against matrices whose solutions are known in integers.
#include "core/numerics/dense_matrix.hpp"

#include <gtest/gtest.h>

namespace qdot {
namespace {

const Eigen::MatrixXd regular{{2, 1, 0}, {1, 3, 1}, {0, 1, 4}};   // determinant 18
const Eigen::MatrixXd singular{{1, 2, 3}, {2, 4, 6}, {1, 0, 1}};  // rank 2
const Eigen::MatrixXd of_rank_one{{1, 2}, {2, 4}};

TEST(DenseMatrix, SolvesARegularSystem) {
  const Eigen::VectorXd x = solve(regular, Eigen::VectorXd{{4, 10, 14}});
  EXPECT_TRUE(x.isApprox(Eigen::VectorXd{{1, 2, 3}}, 1e-15)) << x;
  EXPECT_DOUBLE_EQ(determinant(regular), 18);
  EXPECT_TRUE((inverse(regular) * regular).isIdentity(1e-15));
}

TEST(DenseMatrix, HasNoNumbersForASingularSystem) {
  EXPECT_FALSE(solve(singular, Eigen::VectorXd{{1, 1, 1}}).allFinite());
  EXPECT_FALSE(inverse(singular).allFinite());
}

TEST(DenseMatrix, CountsPivotsAboveTheThreshold) {
  EXPECT_EQ(rank(regular, 1e-12), 3);
  EXPECT_EQ(rank(singular, 1e-12), 2);
  EXPECT_EQ(rank(of_rank_one, 1e-12), 1);
}

TEST(DenseMatrix, PseudoInverseOfAProjection) {
  // (u u^T)^+ = u u^T / |u|^4, u = (1, 2).
  EXPECT_TRUE(pseudo_inverse(of_rank_one).isApprox(of_rank_one / 25, 1e-15)) << pseudo_inverse(of_rank_one);
}

TEST(DenseMatrix, PseudoInverseLeavesOutWhatIsRounding) {
  const Eigen::MatrixXd nearly{{1, 2}, {2, 4 + 1e-15}};
  EXPECT_TRUE(pseudo_inverse(nearly).isApprox(of_rank_one / 25, 1e-12)) << pseudo_inverse(nearly);
}

}  // namespace
}  // namespace qdot
