#include "engine/start/perturbation.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/model/scene.h"
#include "tests/support/panda.h"

namespace stampede {
namespace {

const RandomKey kKey("test");

std::string complaint(const std::string& text) {
  try {
    perturbation_from(text, "--perturb");
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("a perturbation reads back from its canonical text") {
  const Perturbation both = perturbation_from("light=2.5,camera", "");
  CHECK(to_text(both) == "camera=1,light=2.5");
  CHECK(perturbation_from(to_text(both), "") == both);
  CHECK(to_text(Perturbation{}).empty());
}

TEST_CASE("what is no axis or strength is told with a cure") {
  CHECK_THAT(complaint("lihgt"),
             Catch::Contains("--perturb") && Catch::Contains("'lihgt'") && Catch::Contains("light"));
  for (const char* strength : {"light=", "light=0", "light=-1", "light=nan", "light=1e9", "light=2x"})
    CHECK_THAT(complaint(strength), Catch::Contains("is no strength of light"));
  CHECK_THAT(complaint("light,light=2"), Catch::Contains("named twice"));
  CHECK_THAT(complaint(""), Catch::Contains("there is no axis ''"));
}

TEST_CASE("each axis changes its own part of a scene, the same beside others as alone") {
  Scene before = table_scene(2);
  before.cameras.emplace_back().name = "front";
  const auto after = [&](const char* text) {
    Scene scene = before;
    perturb(scene, perturbation_from(text, ""), kKey);
    return scene;
  };
  const auto document = [](const Scene& scene) { return scene_to_document(scene); };
  for (const char* axis : {"layout", "sentence", "noise"}) CHECK(document(after(axis)) == document(before));
  for (const char* axis : {"camera", "start", "light", "texture"}) {
    INFO(axis);
    CHECK(document(after(axis)) != document(before));
    CHECK(document(after(axis)) == document(after(axis)));
  }
  const Scene all = after("camera,start,light,texture");
  CHECK(all.light.direction == after("light").light.direction);
  CHECK(all.light.ambient == after("light").light.ambient);
  for (std::size_t i = 0; i < before.robot.arm.size(); ++i) {
    const auto joint = [&](const Scene& scene) {
      return scene.robot.body.parts[static_cast<std::size_t>(scene.robot.arm[i])].joint;
    };
    CHECK(joint(all).initial == joint(after("start")).initial);
    CHECK(std::abs(joint(all).initial - joint(before).initial) <= 0.2);
    const Joint far = joint(after("start=10"));
    CHECK(far.initial > far.lower);
    CHECK(far.initial < far.upper);
  }
}

TEST_CASE("a sentence keeps its meaning's words, is framed, and stranger the stronger it is disturbed") {
  const std::string sentence = "put the red cube on the table";
  const auto disturbed = [&](const char* text) { return perturbed(sentence, perturbation_from(text, ""), kKey); };
  CHECK(disturbed("light") == sentence);
  CHECK(disturbed("sentence") == disturbed("sentence"));
  CHECK_THAT(disturbed("sentence"), Catch::Contains("set the red block on the worktop"));
  CHECK(disturbed("sentence").size() > sentence.size());
  CHECK_THAT(disturbed("sentence=2"), Catch::Contains("set the red block on the worktop"));
  CHECK(disturbed("sentence=2").size() > disturbed("sentence").size());
  CHECK(disturbed("sentence=3") != disturbed("sentence=2"));
  CHECK(disturbed("sentence=3").size() == disturbed("sentence=2").size());
}

TEST_CASE("things and noise are in proportion to their strength") {
  CHECK(further_things(perturbation_from("layout", "")) == 3);
  CHECK(further_things(perturbation_from("layout=2", "")) == 6);
  CHECK(further_things(perturbation_from("layout=0.1", "")) == 1);
  CHECK(further_things(perturbation_from("noise", "")) == 0);
  CHECK(further_noise(perturbation_from("noise=2", "")).rgb == Approx(0.1));
  CHECK(further_noise({}).torque == 0);
}

}  // namespace stampede
