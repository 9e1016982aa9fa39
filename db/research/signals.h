// What baselines see of an episode or piece: numbers of each frame, read from the given part.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <string>
#include <vector>

#include "db/plain_file.h"

namespace stampede::research {

struct Signals {
  std::int64_t unit = 0;  // number of the episode or piece
  std::string split;
  std::vector<std::int64_t> frames;    // number of each row
  Eigen::MatrixXd position, velocity;  // a row a frame: hinges of the arm, sorted by name (rad, rad/s)
  Eigen::MatrixXd hand;                // x y z qx qy qz qw, linear velocity, angular velocity, opening, two forces
  bool touch = true;                   // the forces were measured; if not, they are 0
  Eigen::VectorXd opening() const { return hand.col(13); }
};

// Of all units whose split is in `splits`, by number. The joints are the arm's, from the base on; the hand has its
// opening.
std::vector<Signals> signals_of(const PlainFile& given, const std::vector<std::string>& splits);

// Joint speeds, speed and height of the tip, opening and how it changes, forces where they were measured: what segments
// are found by.
Eigen::MatrixXd motion_features(const Signals& signals);

// Mean and deviation of columns, for features of one scale.
struct Scale {
  Eigen::RowVectorXd mean, deviation;
  explicit Scale(const Eigen::MatrixXd& rows);
  Eigen::MatrixXd of(const Eigen::MatrixXd& rows) const;
};

// Ridge regression with an offset: weights of (features, 1).
Eigen::MatrixXd ridge(const Eigen::MatrixXd& features, const Eigen::MatrixXd& targets, double penalty);
Eigen::MatrixXd apply_ridge(const Eigen::MatrixXd& features, const Eigen::MatrixXd& weights);

Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& parts);  // below each other; of equal columns

// Lloyd's algorithm from k-means++ starts (Arthur, Vassilvitskii, SODA 2007), the best of some; drawn from a fixed key.
std::vector<int> k_means(const Eigen::MatrixXd& rows, int clusters);

}  // namespace stampede::research
