#include "engine/motion/ompl_planners.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/est/ProjEST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/pdst/PDST.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rlrt/BiRLRT.h>
#include <ompl/geometric/planners/rlrt/RLRT.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyLBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/sst/SST.h>
#include <ompl/geometric/planners/stride/STRIDE.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/base/stopping.h"

namespace stampede {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using JointSpace = ob::RealVectorStateSpace;

JointVector joints_of(const ob::State* state, std::size_t count) {
  const double* values = state->as<JointSpace::StateType>()->values;
  return Eigen::Map<const Eigen::VectorXd>(values, static_cast<Eigen::Index>(count));
}

// Edges are asked about as our own planner does.
class CheckedEdges : public ob::MotionValidator {
 public:
  CheckedEdges(const ob::SpaceInformationPtr& space, Checker& checker, std::size_t joints, double step_rad)
      : ob::MotionValidator(space), checker_(checker), joints_(joints), step_rad_(step_rad) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return checker_.edge_free(joints_of(from, joints_), joints_of(to, joints_), step_rad_);
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    const JointVector a = joints_of(from, joints_), b = joints_of(to, joints_);
    const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil((b - a).norm() / step_rad_)));
    std::vector<JointVector> between;
    for (std::size_t i = 1; i <= steps; ++i)
      between.push_back(a + static_cast<double>(i) / static_cast<double>(steps) * (b - a));
    const std::size_t free = checker_.first_touching(between);
    if (free == steps) return true;
    last_valid.second = static_cast<double>(free) / static_cast<double>(steps);
    if (last_valid.first) si_->getStateSpace()->interpolate(from, to, last_valid.second, last_valid.first);
    return false;
  }

 private:
  Checker& checker_;
  std::size_t joints_;
  double step_rad_;
};

// PRM and PRM* look for a path in a second thread, and grow by the clock: here in turns, by counts.
class SteadyPRM : public og::PRM {
 public:
  using og::PRM::PRM;

  ob::PlannerStatus solve(const ob::PlannerTerminationCondition& stop) override {
    constexpr int kGrown = 40, kExpanded = 10;
    checkValidity();
    while (const ob::State* state = pis_.nextStart()) startM_.push_back(addMilestone(si_->cloneState(state)));
    while (const ob::State* state = pis_.nextGoal()) goalM_.push_back(addMilestone(si_->cloneState(state)));
    if (startM_.empty() || goalM_.empty()) return ob::PlannerStatus::INVALID_START;
    while (!stop()) {
      for (const auto& [grow, turns] : {std::pair(true, kGrown), std::pair(false, kExpanded)}) {
        const ob::PlannerTerminationCondition enough([&stop, left = turns]() mutable { return left-- <= 0 || stop(); });
        grow ? growRoadmap(enough) : expandRoadmap(enough);
      }
      ob::PathPtr path;
      if (!maybeConstructSolution(startM_, goalM_, path)) continue;
      pdef_->addSolutionPath(path, false, 0, getName());
      return ob::PlannerStatus::EXACT_SOLUTION;
    }
    return ob::PlannerStatus::TIMEOUT;
  }
};

using Maker = std::function<ob::PlannerPtr(const ob::SpaceInformationPtr&)>;

template <typename Planner>
std::pair<const std::string, Maker> made(const char* name) {
  return {name, [](const ob::SpaceInformationPtr& space) { return std::make_shared<Planner>(space); }};
}

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> all = {
      made<og::ABITstar>("ABITstar"),
      made<og::AITstar>("AITstar"),
      made<og::BFMT>("BFMT"),
      made<og::BITstar>("BITstar"),
      made<og::BKPIECE1>("BKPIECE1"),
      made<og::BiEST>("BiEST"),
      made<og::BiRLRT>("BiRLRT"),
      made<og::BiTRRT>("BiTRRT"),
      made<og::EST>("EST"),
      made<og::FMT>("FMT"),
      made<og::InformedRRTstar>("InformedRRTstar"),
      made<og::KPIECE1>("KPIECE1"),
      made<og::LBKPIECE1>("LBKPIECE1"),
      made<og::LBTRRT>("LBTRRT"),
      made<og::LazyLBTRRT>("LazyLBTRRT"),
      made<og::LazyPRM>("LazyPRM"),
      made<og::LazyPRMstar>("LazyPRMstar"),
      made<og::LazyRRT>("LazyRRT"),
      made<og::PDST>("PDST"),
      {"PRM", [](const ob::SpaceInformationPtr& space) { return std::make_shared<SteadyPRM>(space); }},
      {"PRMstar", [](const ob::SpaceInformationPtr& space) { return std::make_shared<SteadyPRM>(space, true); }},
      made<og::ProjEST>("ProjEST"),
      made<og::RLRT>("RLRT"),
      made<og::RRT>("RRT"),
      made<og::RRTConnect>("RRTConnect"),
      made<og::RRTXstatic>("RRTXstatic"),
      made<og::RRTsharp>("RRTsharp"),
      made<og::RRTstar>("RRTstar"),
      made<og::SBL>("SBL"),
      made<og::SORRTstar>("SORRTstar"),
      made<og::SST>("SST"),
      made<og::STRIDE>("STRIDE"),
      made<og::TRRT>("TRRT"),
  };
  return all;
}

ob::SpaceInformationPtr space_of(const PathQuery& query, double step_rad) {
  const auto& [checker, limits, start, goal] = query;
  const auto space = std::make_shared<JointSpace>(static_cast<unsigned>(limits.size()));
  ob::RealVectorBounds bounds(static_cast<unsigned>(limits.size()));
  for (unsigned i = 0; i < limits.size(); ++i) {  // an arm pressed against a joint limit may stand a little beyond it
    const auto j = static_cast<Eigen::Index>(i);
    bounds.setLow(i, std::min({limits[i].lower, start[j], goal[j]}));
    bounds.setHigh(i, std::max({limits[i].upper, start[j], goal[j]}));
  }
  space->setBounds(bounds);
  auto information = std::make_shared<ob::SpaceInformation>(space);
  const std::size_t joints = limits.size();
  information->setStateValidityChecker(
      [&checker = query.checker, joints](const ob::State* state) { return checker.free(joints_of(state, joints)); });
  information->setMotionValidator(std::make_shared<CheckedEdges>(information, checker, joints, step_rad));
  information->setup();
  return information;
}

}  // namespace

std::vector<std::string> ompl_planner_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers()) names.push_back(name);
  return names;
}

std::string why_not_offered(std::string_view planner) {
  static const std::map<std::string, std::string, std::less<>> reasons = {
      {"AnytimePathShortening", "it runs several planners in threads: not reproducible"},
      {"CForest", "it runs in several threads: not reproducible"},
      {"LightningRetrieveRepair", "it needs paths that were planned before"},
      {"QRRT", "it needs a sequence of simpler spaces"},
      {"SPARS", "it looks for paths in a second thread: not reproducible"},
      {"SPARStwo", "it looks for paths in a second thread: not reproducible"},
      {"TSRRT", "it needs a task space"},
      {"ThunderRetrieveRepair", "it needs paths that were planned before"},
      {"VFRRT", "it needs a vector field"},
      {"XXL", "it needs a decomposition of the workspace"},
      {"pRRT", "it runs in several threads: not reproducible"},
      {"pSBL", "it runs in several threads: not reproducible"},
  };
  const auto found = reasons.find(planner);
  return found == reasons.end() ? "" : found->second;
}

std::vector<JointVector> plan_with_ompl(const std::string& planner, const PathQuery& query, const TreeOptions& options,
                                        RandomKey key) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);  // process-wide; the library is silent
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(1 + Random(key).below(2'000'000'000)));
  const ob::SpaceInformationPtr space = space_of(query, options.step_rad);
  ob::ScopedState<JointSpace> from(space), to(space);
  for (Eigen::Index i = 0; i < query.start.size(); ++i) {
    from->values[i] = query.start[i];
    to->values[i] = query.goal[i];
  }
  const auto problem = std::make_shared<ob::ProblemDefinition>(space);
  problem->setStartAndGoalStates(from, to);
  const ob::PlannerPtr search = makers().at(planner)(space);
  search->setProblemDefinition(problem);
  search->setup();
  int left = std::max(1, options.iterations);
  search->solve(
      ob::PlannerTerminationCondition([&] { return left-- <= 0 || stop_asked() || problem->hasExactSolution(); }));
  heed_stop();
  if (!problem->hasExactSolution()) return {};
  const auto* path = problem->getSolutionPath()->as<og::PathGeometric>();
  std::vector<JointVector> waypoints;
  for (const ob::State* state : const_cast<og::PathGeometric*>(path)->getStates())
    waypoints.push_back(joints_of(state, query.limits.size()));
  return waypoints;
}

}  // namespace stampede
