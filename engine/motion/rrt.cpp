#include "engine/motion/rrt.h"

#include <ompl/base/Planner.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <mutex>

#include "engine/motion/nearest.h"

namespace stampede {
namespace {

namespace ob = ompl::base;
using Space = ob::RealVectorStateSpace;

JointVector to_joints(const ob::State* state, unsigned joints) {
  JointVector q(static_cast<Eigen::Index>(joints));
  for (unsigned i = 0; i < joints; ++i) q[static_cast<Eigen::Index>(i)] = state->as<Space::StateType>()->values[i];
  return q;
}

void from_joints(const JointVector& q, ob::State* state) {
  for (Eigen::Index i = 0; i < q.size(); ++i) state->as<Space::StateType>()->values[i] = q[i];
}

struct TreeNode {
  JointVector q;
  TreeNode* parent = nullptr;
};

// A tree's nodes, and where they are.
class JointTree {
 public:
  explicit JointTree(std::size_t joints) : joints_(joints) {}

  void add(TreeNode* node) {
    constexpr float kFar = 1e9F;
    const std::size_t lane = nodes_.size() % kNearestLanes;
    if (lane == 0) {
      places_.resize(places_.size() + joints_);
      for (std::size_t j = places_.size() - joints_; j < places_.size(); ++j)
        std::fill_n(places_[j].v, kNearestLanes, kFar);
    }
    for (std::size_t j = 0; j < joints_; ++j)
      places_[places_.size() - joints_ + j].v[lane] = static_cast<float>(node->q[static_cast<Eigen::Index>(j)]);
    nodes_.push_back(node);
  }

  TreeNode* nearest(const JointVector& q) const {
    std::array<float, 16> wanted{};
    for (std::size_t j = 0; j < joints_; ++j) wanted[j] = static_cast<float>(q[static_cast<Eigen::Index>(j)]);
    return nodes_[nearest_(places_.data(), places_.size() / joints_, static_cast<int>(joints_), wanted.data())];
  }

  std::size_t size() const { return nodes_.size(); }
  const JointVector& place(std::size_t node) const { return nodes_[node]->q; }

 private:
  std::size_t joints_;
  std::vector<TreeNode*> nodes_;
  std::vector<EightFloats> places_;
  const Nearest nearest_ = fastest_nearest();
};

// OMPL's own planners draw from generators seeded in the order of their creation in the process; this one draws
// from its key only.
class KeyedConnect : public ob::Planner {
 public:
  KeyedConnect(const ob::SpaceInformationPtr& si, const PathQuery& query, const TreeOptions& options, RandomKey key)
      : ob::Planner(si, "KeyedConnect"),
        checker_(query.checker),
        limits_(query.limits),
        options_(options),
        random_(key),
        trees_{JointTree(query.limits.size()), JointTree(query.limits.size())} {}

  ob::PlannerStatus solve(const ob::PlannerTerminationCondition& stop) override {
    const unsigned joints = si_->getStateDimension();
    const auto* goal = pdef_->getGoal()->as<ob::GoalState>();
    start_ = to_joints(pdef_->getStartState(0), joints);
    goal_ = to_joints(goal->getState(), joints);
    longest_ = kLeastDetour * (goal_ - start_).norm() + kLeastRoom;
    trees_[0].add(make(start_, nullptr));
    trees_[1].add(make(goal_, nullptr));
    while (!stop()) {
      const std::size_t grown = trees_[0].size() <= trees_[1].size() ? 0 : 1;
      const bool stuck = in_vain_ >= kStuck && random_.below(2) == 0;
      TreeNode* reached = extend(trees_[grown], stuck ? sample_beside(trees_[grown]) : sample());
      in_vain_ = reached ? 0 : in_vain_ + 1;
      if (!reached) continue;
      TreeNode* other = connect(trees_[1 - grown], reached->q);
      if (!other || joint_gap(other->q, reached->q) > 1e-12) continue;
      store(grown == 0 ? reached : other, grown == 0 ? other : reached);
      return ob::PlannerStatus::EXACT_SOLUTION;
    }
    return ob::PlannerStatus::TIMEOUT;
  }

 private:
  TreeNode* make(const JointVector& q, TreeNode* parent) {
    nodes_.push_back({q, parent});
    return &nodes_.back();
  }

  // Uniform among the configurations through which a path could go that is no longer than `longest_`, which grows with
  // the number of samples (Gammell, Srinivasa, Barfoot, IROS 2014, doi:10.1109/IROS.2014.6942976): first paths are
  // shorter, and found sooner.
  JointVector sample() {
    if (++samples_ % kSamplesEach == 0) longest_ *= kGrowth;
    JointVector q(static_cast<Eigen::Index>(limits_.size()));
    for (int attempt = 1;; ++attempt) {
      for (std::size_t i = 0; i < limits_.size(); ++i)
        q[static_cast<Eigen::Index>(i)] = random_.between(limits_[i].lower, limits_[i].upper);
      if ((q - start_).norm() + (q - goal_).norm() <= longest_) return q;
      if (attempt % kAttempts == 0) longest_ *= kGrowth;
    }
  }

  // Near a configuration of the tree: out of a pocket that random directions do not lead out of.
  JointVector sample_beside(const JointTree& tree) {
    JointVector q = tree.place(static_cast<std::size_t>(random_.below(static_cast<int>(tree.size()))));
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      double& value = q[static_cast<Eigen::Index>(i)];
      value = std::clamp(value + random_.between(-kBeside, kBeside), limits_[i].lower, limits_[i].upper);
    }
    return q;
  }

  // One extension of at most range_rad from the nearest node; nothing when it is blocked.
  TreeNode* extend(JointTree& tree, const JointVector& target) {
    TreeNode* near = tree.nearest(target);
    const double distance = (target - near->q).norm();
    if (distance < 1e-12) return near;
    const JointVector q = distance <= options_.range_rad
                              ? target
                              : JointVector(near->q + (options_.range_rad / distance) * (target - near->q));
    if (!checker_.edge_free(near->q, q, options_.step_rad)) return nullptr;
    TreeNode* added = make(q, near);
    tree.add(added);
    return added;
  }

  // Extends towards the target until there or blocked; the last node added.
  TreeNode* connect(JointTree& tree, const JointVector& target) {
    TreeNode* last = nullptr;
    while (TreeNode* next = extend(tree, target)) {
      last = next;
      if ((next->q - target).norm() < 1e-12) break;
    }
    return last;
  }

  void store(const TreeNode* from_start, const TreeNode* from_goal) {
    std::vector<JointVector> joints;
    for (const TreeNode* node = from_start; node; node = node->parent) joints.push_back(node->q);
    std::reverse(joints.begin(), joints.end());
    for (const TreeNode* node = from_goal->parent; node; node = node->parent) joints.push_back(node->q);
    auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
    ob::ScopedState<Space> state(si_);
    for (const JointVector& q : joints) {
      from_joints(q, state.get());
      path->append(state.get());
    }
    pdef_->addSolutionPath(path);
  }

  static constexpr double kLeastDetour = 1.2, kLeastRoom = 1;  // times the straight way, and rad more
  static constexpr double kGrowth = 1.3;
  static constexpr int kSamplesEach = 500, kAttempts = 200;
  static constexpr int kStuck = 50;       // extensions in vain
  static constexpr double kBeside = 0.3;  // rad, each joint

  Checker& checker_;
  const std::vector<JointLimits>& limits_;
  TreeOptions options_;
  Random random_;
  JointVector start_, goal_;
  double longest_ = 0;  // rad, of the paths looked for
  int samples_ = 0, in_vain_ = 0;
  std::deque<TreeNode> nodes_;  // stable addresses
  JointTree trees_[2];
};

ob::SpaceInformationPtr make_space(const PathQuery& query) {
  const auto& [checker, limits, start, goal] = query;
  auto space = std::make_shared<Space>(static_cast<unsigned>(limits.size()));
  ob::RealVectorBounds bounds(static_cast<unsigned>(limits.size()));
  for (unsigned i = 0; i < limits.size(); ++i) {
    // An arm pressed against a joint limit may stand a little beyond it.
    const Eigen::Index j = static_cast<Eigen::Index>(i);
    bounds.setLow(i, std::min({limits[i].lower, start[j], goal[j]}));
    bounds.setHigh(i, std::max({limits[i].upper, start[j], goal[j]}));
  }
  space->setBounds(bounds);
  auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker([](const ob::State*) { return true; });  // KeyedConnect asks its Checker
  si->setup();
  return si;
}

}  // namespace

std::vector<JointVector> grow_trees(const PathQuery& query, const TreeOptions& options, RandomKey key) {
  static std::once_flag silenced;  // OMPL's log is process-wide; the library is silent
  std::call_once(silenced, [] { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); });
  const ob::SpaceInformationPtr si = make_space(query);
  ob::ScopedState<Space> from(si), to(si);
  from_joints(query.start, from.get());
  from_joints(query.goal, to.get());
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->setStartAndGoalStates(from, to);
  KeyedConnect planner(si, query, options, key);
  planner.setProblemDefinition(problem);
  const ob::IterationTerminationCondition count(static_cast<unsigned>(std::max(1, options.iterations)));
  ob::IterationTerminationCondition stop = count;
  if (planner.solve(ob::PlannerTerminationCondition([&stop] { return stop.eval(); })) !=
      ob::PlannerStatus::EXACT_SOLUTION)
    return {};
  const auto* path = problem->getSolutionPath()->as<ompl::geometric::PathGeometric>();
  std::vector<JointVector> waypoints;
  for (std::size_t i = 0; i < path->getStateCount(); ++i)
    waypoints.push_back(
        to_joints(path->getState(static_cast<unsigned>(i)), static_cast<unsigned>(query.limits.size())));
  return waypoints;
}

}  // namespace stampede
