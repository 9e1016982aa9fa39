#include "engine/motion/rrt.h"

#include <ompl/base/Planner.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <mutex>

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

// OMPL's own planners draw from generators seeded in the order of their creation in the process; this one draws
// from its key only, and its nearest neighbours are searched linearly (the default structure owns a generator).
class KeyedConnect : public ob::Planner {
 public:
  KeyedConnect(const ob::SpaceInformationPtr& si, const Checker& checker, const std::vector<JointLimits>& limits,
               const TreeOptions& options, RandomKey key)
      : ob::Planner(si, "KeyedConnect"), checker_(checker), limits_(limits), options_(options), random_(key) {
    for (auto& tree : trees_)
      tree.setDistanceFunction([](Node* const& a, Node* const& b) { return (a->q - b->q).norm(); });
  }

  ob::PlannerStatus solve(const ob::PlannerTerminationCondition& stop) override {
    const unsigned joints = si_->getStateDimension();
    const auto* goal = pdef_->getGoal()->as<ob::GoalState>();
    trees_[0].add(make(to_joints(pdef_->getStartState(0), joints), nullptr));
    trees_[1].add(make(to_joints(goal->getState(), joints), nullptr));
    for (std::size_t grown = 0; !stop(); grown = 1 - grown) {
      Node* reached = extend(trees_[grown], sample());
      if (!reached) continue;
      Node* other = connect(trees_[1 - grown], reached->q);
      if (!other || joint_gap(other->q, reached->q) > 1e-12) continue;
      store(grown == 0 ? reached : other, grown == 0 ? other : reached);
      return ob::PlannerStatus::EXACT_SOLUTION;
    }
    return ob::PlannerStatus::TIMEOUT;
  }

 private:
  struct Node {
    JointVector q;
    Node* parent = nullptr;
  };
  using Tree = ompl::NearestNeighborsLinear<Node*>;

  Node* make(const JointVector& q, Node* parent) {
    nodes_.push_back({q, parent});
    return &nodes_.back();
  }

  JointVector sample() {
    JointVector q(static_cast<Eigen::Index>(limits_.size()));
    for (std::size_t i = 0; i < limits_.size(); ++i)
      q[static_cast<Eigen::Index>(i)] = random_.between(limits_[i].lower, limits_[i].upper);
    return q;
  }

  // One extension of at most range_rad from the nearest node; nothing when it is blocked.
  Node* extend(Tree& tree, const JointVector& target) {
    Node probe{target, nullptr};
    Node* near = tree.nearest(&probe);
    const double distance = (target - near->q).norm();
    if (distance < 1e-12) return near;
    const JointVector q = distance <= options_.range_rad
                              ? target
                              : JointVector(near->q + (options_.range_rad / distance) * (target - near->q));
    if (!checker_.edge_free(near->q, q, options_.step_rad)) return nullptr;
    Node* added = make(q, near);
    tree.add(added);
    return added;
  }

  // Extends towards the target until there or blocked; the last node added.
  Node* connect(Tree& tree, const JointVector& target) {
    Node* last = nullptr;
    while (Node* next = extend(tree, target)) {
      last = next;
      if ((next->q - target).norm() < 1e-12) break;
    }
    return last;
  }

  void store(const Node* from_start, const Node* from_goal) {
    std::vector<JointVector> joints;
    for (const Node* node = from_start; node; node = node->parent) joints.push_back(node->q);
    std::reverse(joints.begin(), joints.end());
    for (const Node* node = from_goal->parent; node; node = node->parent) joints.push_back(node->q);
    auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
    ob::ScopedState<Space> state(si_);
    for (const JointVector& q : joints) {
      from_joints(q, state.get());
      path->append(state.get());
    }
    pdef_->addSolutionPath(path);
  }

  const Checker& checker_;
  const std::vector<JointLimits>& limits_;
  TreeOptions options_;
  Random random_;
  std::deque<Node> nodes_;  // stable addresses
  Tree trees_[2];
};

ob::SpaceInformationPtr make_space(const std::vector<JointLimits>& limits, const JointVector& start,
                                   const JointVector& goal) {
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

std::vector<JointVector> grow_trees(const Checker& checker, const std::vector<JointLimits>& limits,
                                    const JointVector& start, const JointVector& goal, const TreeOptions& options,
                                    RandomKey key) {
  static std::once_flag silenced;  // OMPL's log is process-wide; the library is silent
  std::call_once(silenced, [] { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); });
  const ob::SpaceInformationPtr si = make_space(limits, start, goal);
  ob::ScopedState<Space> from(si), to(si);
  from_joints(start, from.get());
  from_joints(goal, to.get());
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->setStartAndGoalStates(from, to);
  KeyedConnect planner(si, checker, limits, options, key);
  planner.setProblemDefinition(problem);
  const ob::IterationTerminationCondition count(static_cast<unsigned>(std::max(1, options.iterations)));
  ob::IterationTerminationCondition stop = count;
  if (planner.solve(ob::PlannerTerminationCondition([&stop] { return stop.eval(); })) !=
      ob::PlannerStatus::EXACT_SOLUTION)
    return {};
  const auto* path = problem->getSolutionPath()->as<ompl::geometric::PathGeometric>();
  std::vector<JointVector> waypoints;
  for (std::size_t i = 0; i < path->getStateCount(); ++i)
    waypoints.push_back(to_joints(path->getState(static_cast<unsigned>(i)), static_cast<unsigned>(limits.size())));
  return waypoints;
}

}  // namespace stampede
