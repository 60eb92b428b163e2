// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "base/decompositions.hpp"
#include "base/random.hpp"

namespace fragmotion {
namespace {

class Numbers {
 public:
  double operator()() { return 2 * random_.uniform() - 1; }

  Eigen::MatrixXd matrix(int rows, int columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [this] { return (*this)(); });
  }

  Quaternion rotation() { return Quaternion{(*this)(), (*this)(), (*this)(), (*this)()}.normalized(); }

 private:
  Random random_{7};
};

TEST(Decompositions, OfLeastSquaresLeaveWhatIsAcrossEachColumn) {
  Numbers numbers;
  const Eigen::MatrixXd columns = numbers.matrix(9, 3);
  const Eigen::VectorXd values = numbers.matrix(9, 1);
  const Eigen::VectorXd left = values - columns * least_squares(columns, values);
  EXPECT_LT((columns.transpose() * left).norm(), 1e-12);
  EXPECT_GT(left.norm(), 0.1);
}

// A matrix is the nearest rotation times a stretch along axes across each other: its polar decomposition.
TEST(Decompositions, FindTheRotationOfWhatIsStretchedAndThenTurned) {
  Numbers numbers;
  for (int i = 0; i < 20; ++i) {
    const Quaternion turn = numbers.rotation(), axes = numbers.rotation();
    const Eigen::Matrix3d stretch = axes.toRotationMatrix() * Vector3{0.3, 1, 2}.asDiagonal() *
                                    axes.toRotationMatrix().transpose(),
                          stretched = turn.toRotationMatrix() * stretch;
    EXPECT_LT(nearest_rotation(stretched).angularDistance(turn), 1e-12);
    EXPECT_LT((nearest_orthogonal(stretched) - turn.toRotationMatrix()).norm(), 1e-12);
    EXPECT_LT((principal_axes(stretch).col(0).cross(axes * Vector3::UnitZ())).norm(), 1e-12);
    EXPECT_NEAR(nearest_orthogonal(-stretched).determinant(), -1, 1e-12);
    EXPECT_NEAR(nearest_rotation(-stretched).norm(), 1, 1e-12);
  }
}

}  // namespace
}  // namespace fragmotion
