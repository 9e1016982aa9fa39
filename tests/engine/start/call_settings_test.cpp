// Continuous parameters and controllers as people write them.
#include "engine/start/call_settings.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/start/declared.h"
#include "tests/support/plain_task.h"

using namespace stampede;

namespace {

const SkillInfo& pick() {
  static const plain::PlainSkills skills;
  return *skills.skill("pick");
}

void check(const std::string& text) {
  std::map<std::string, CallSettings> set;
  add_skill_setting(text, set, "--set");
  check_settings(pick(), set.at("pick"), "--set");
}

}  // namespace

TEST_CASE("settings are read, and said again as they were written") {
  std::map<std::string, CallSettings> set;
  for (const char* text : {"push.direction=0,-0.5,1e-3", "pick.height=0.2", "push.direction.2=0.25",
                           "pick.controller=cartesian_impedance"})
    add_skill_setting(text, set, "--set");
  CHECK(set.at("pick").values == std::vector<CallSettings::Value>{{"height", 0, {0.2}}});
  CHECK(set.at("pick").controller == ControllerKind::cartesian_impedance);
  CHECK(set.at("push").values[1] == CallSettings::Value{"direction", 2, {0.25}});
  CHECK(to_text(set) ==
        "pick.height=0.2 pick.controller=cartesian_impedance push.direction=0,-0.5,0.001 push.direction.2=0.25");
}

TEST_CASE("settings that cannot be are refused with what there is") {
  const auto says = [](const char* text) { return Catch::Contains(text); };
  CHECK_THROWS_WITH(check("pick"), says("sets nothing"));
  CHECK_THROWS_WITH(check("pick.=1"), says("SKILL.PARAMETER=VALUE"));
  CHECK_THROWS_WITH(check("pick.height=tall"), says("'tall' is no number"));
  CHECK_THROWS_WITH(check("pick.height="), says("is no number"));
  CHECK_THROWS_WITH(check("pick.height=nan"), says("must be finite"));
  CHECK_THROWS_WITH(check("pick.hight=0.2"), says("no continuous parameter 'hight'") && says("'height'"));
  CHECK_THROWS_WITH(check("pick.height=0.31"), says("at most 0.3m, not 0.31"));
  CHECK_THROWS_WITH(check("pick.height=0.01"), says("at least 0.02m, not 0.01"));
  CHECK_THROWS_WITH(check("pick.height=0.1,0.2"), says("has 1 values, not 2"));
  CHECK_THROWS_WITH(check("pick.height.2=0.1"), says("components 1 to 1"));
  CHECK_THROWS_WITH(check("pick.height.0=0.1"), says("count from 1"));
  CHECK_THROWS_WITH(check("pick.grasp.1=0.1"), says("as a whole"));
  CHECK_THROWS_WITH(check("pick.grasp=1,2,3"), says("7 values, not 3"));
  CHECK_THROWS_WITH(check("pick.grasp=0,0,0,0,0,0,0"), says("no length"));
  CHECK_THROWS_WITH(check("pick.controller=magic"), says("no controller 'magic'") && says("joint_impedance"));
  CHECK_NOTHROW(check("pick.height=0.3"));
  CHECK_NOTHROW(check("pick.grasp=0,0,0,0,0,0,1"));
}

TEST_CASE("a run that sets what no skill has ends before it begins") {
  plain::PlainSymbols symbols;
  plain::PlainSkills skills;
  RunOptions options;
  options.set["pik"].values = {{"height", 0, {0.2}}};
  CHECK_THROWS_WITH(run_episode(plain::stack_draw(), symbols, skills, options), Catch::Contains("no skill 'pik'"));
}

TEST_CASE("what is set is part of what tells two runs apart") {
  RunOptions plain_run, higher;
  higher.set["pick"].values = {{"height", 0, {0.2}}};
  CHECK(plain_run.as_text().count("set") == 0);
  CHECK(higher.as_text().at("set") == "pick.height=0.2");
}
