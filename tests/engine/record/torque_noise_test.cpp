// What torque sensors say beside the truth: as text and back, for the right arm, the same for equal keys.
#include "engine/record/torque_noise.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/record/observation.h"

using namespace stampede;

namespace {

TorqueNoise two_joints() {
  TorqueNoise noise;
  noise.drift_time_s = 30;
  noise.recorded_s = 60;
  noise.joints = {{"joint1", 0.5, 0.02, 0.3, 0.1, 0.4, 0.0}, {"joint2", 0.1, 0.05, 1.0 / 3.0, -0.2, 1e-17, 0.25}};
  return noise;
}

double error_of(const TorqueNoise& noise, std::size_t joint, double velocity, double since_on_s) {
  Random random(RandomKey("test"));
  return torque_error(noise, joint, velocity, since_on_s, random);
}

}  // namespace

TEST_CASE("a torque noise as text is the same again, to the last bit") {
  const TorqueNoise noise = two_joints();
  const TorqueNoise again = torque_noise_from(to_text(noise));
  CHECK(to_text(again) == to_text(noise));
  REQUIRE(again.joints.size() == 2);
  CHECK(again.joints[1].viscous == 1.0 / 3.0);
  CHECK(again.joints[1].drift == 1e-17);
  CHECK(torque_noise_from("").empty());
  CHECK(to_text(TorqueNoise{}).empty());
  for (const char* bad : {"30", "30 60,joint1 1 2", "30 60,joint1 a 1 1 1 1 1", "30 nan,joint1 1 1 1 1 1 1"})
    CHECK_THROWS_AS(torque_noise_from(bad), Error);
}

TEST_CASE("an episode's options keep the torque noise") {
  ObservationChoice choice;
  choice.torque_model = two_joints();
  EpisodeRecord episode;
  episode.made.options = choice.as_text();
  CHECK(to_text(*observation_of(episode).torque_model) == to_text(two_joints()));
  CHECK(chosen(choice).torque_model.joints.size() == 2);
}

TEST_CASE("friction is against both ways of turning, and warmth comes slowly") {
  const TorqueNoise noise = two_joints();
  CHECK(error_of(noise, 0, 0, 0) == Approx(0.1));
  CHECK(error_of(noise, 0, 1, 0) == Approx(0.5 + 0.3 + 0.1));
  CHECK(error_of(noise, 0, -1, 0) == Approx(-0.5 - 0.3 + 0.1));
  CHECK(error_of(noise, 0, 0.02, 0) == Approx(0.5 * std::tanh(1.0) + 0.3 * 0.02 + 0.1));
  CHECK(error_of(noise, 0, 0, 30) == Approx(0.1 + 0.4 * (1 - std::exp(-1.0))));
  CHECK(error_of(noise, 0, 0, 1e6) == Approx(0.5));
  double sum = 0, squares = 0;
  Random random(RandomKey("white"));
  for (int i = 0; i < 4000; ++i) {
    const double off = torque_error(noise, 1, 0, 0, random) + 0.2;
    sum += off, squares += off * off;
  }
  CHECK(sum / 4000 == Approx(0).margin(0.02));
  CHECK(std::sqrt(squares / 4000) == Approx(0.25).epsilon(0.05));
}

TEST_CASE("a torque noise is put into the order of an arm, and another robot's is refused") {
  const TorqueNoise noise = two_joints();
  CHECK(of_arm(noise, {"joint2", "joint1"}).joints[0].joint == "joint2");
  CHECK_THROWS_WITH(of_arm(noise, {"joint1", "joint2", "joint3"}), Catch::Contains("it says nothing of joint3"));
  CHECK_THROWS_WITH(of_arm(noise, {"joint1"}), Catch::Contains("has no joint 'joint2'"));
}

TEST_CASE("an episode begins at some moment of the recording, the same for the same key") {
  const TorqueNoise noise = two_joints();
  const double first = warm_up_s(noise, RandomKey("a"));
  CHECK(first == warm_up_s(noise, RandomKey("a")));
  CHECK(first != warm_up_s(noise, RandomKey("b")));
  CHECK((first >= 0 && first < 60));
  CHECK(warm_up_s(TorqueNoise{}, RandomKey("a")) == 0);
}
