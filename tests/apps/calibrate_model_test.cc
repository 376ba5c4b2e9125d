// The model of responses that a search goes by.
#include <gtest/gtest.h>

#include "apps/calibrate/response_model.h"

namespace platen::apps {
namespace {

TEST(ResponseModel, learns_the_slopes_of_a_linear_response) {
  Eigen::MatrixXd slopes(2, 2), guess(2, 2);
  slopes << 1, -2, 0.3, 4;
  guess << 1, 0, 0, 1;
  ResponseModel model({{0, -9, 9, 1, false}, {0, -9, 9, 1, false}}, guess);
  for (const auto &[x, y] : {std::pair{0.0, 0.0}, {0.9, 0.1}, {-0.4, 0.8}, {0.7, 0.7}})
    model.add(Eigen::Vector2d(x, y), slopes * Eigen::Vector2d(x, y) + Eigen::Vector2d(2, 1));
  // The guess weighs as much as one trial a thirtieth of a large change away: a hundredth of these.
  EXPECT_LT((model.slopes() - slopes).norm(), 0.03 * (guess - slopes).norm());
}

TEST(ResponseModel, keeps_to_bounds_and_to_a_step) {
  ResponseModel model({{2, 0, 1, 0.3, false}}, Eigen::MatrixXd::Constant(1, 1, 1.0));
  EXPECT_EQ(model.start()[0], 1);
  model.add(model.start(), Eigen::VectorXd::Constant(1, 5.0));
  EXPECT_NEAR((*model.next())[0], 0.7, 1e-6); // a step towards less
  model.add(Eigen::VectorXd::Constant(1, 0.7), Eigen::VectorXd::Constant(1, 6.0));
  EXPECT_FALSE(model.next()); // the response falls with the parameter, which is at its bound
}

TEST(ResponseModel, leaves_known_slopes_as_they_are) {
  ResponseModel model({{0, -9, 9, 9, true}}, Eigen::MatrixXd::Constant(1, 1, 1.0));
  model.add(Eigen::VectorXd::Constant(1, 0.0), Eigen::VectorXd::Constant(1, 1.0));
  model.add(Eigen::VectorXd::Constant(1, -1.0), Eigen::VectorXd::Constant(1, 0.1));
  EXPECT_NEAR(model.slopes()(0, 0), 1, 1e-5);
  EXPECT_NEAR((*model.next())[0], -1.1, 1e-4);
}

} // namespace
} // namespace platen::apps
