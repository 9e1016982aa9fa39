// What robot:follow asks for, as ways of the tip: where each piece leads, worked out by hand.
#include <catch2/catch.hpp>
#include <numbers>

#include "engine/rollout/call_follow.h"
#include "engine/rollout/call_motion.h"
#include "engine/start/world_view.h"
#include "tests/support/panda.h"

using namespace stampede;
using namespace stampede::robot_call;

namespace {

constexpr double kQuarter = std::numbers::pi / 2;

// The tool points down at (0.5, 0, 0.3), its x along the world's.
const Transform kStart = translation(0.5, 0, 0.3) * rotation_rpy(std::numbers::pi, 0, 0);

struct Ways {
  World world{std::make_shared<Scene>(table_scene(1))};
  WorldView view{world};
  std::vector<ToolPiece> operator()(std::vector<Piece> pieces) const {
    Follow call;
    call.pieces = std::move(pieces);
    return tool_pieces(call.pieces, view, kStart);
  }
  Transform end(std::vector<Piece> pieces) const { return (*this)(std::move(pieces)).back().world_from_tip(1); }
};

double turn_between(const Transform& a, const Transform& b) {
  return angle_between(Quaternion(a.linear()), Quaternion(b.linear()));
}

}  // namespace

TEST_CASE("pieces follow one another: each begins where the last one ends") {
  const Ways ways;
  const auto pieces =
      ways({{piece::Offset{{0, 0.1, 0}}}, {piece::Arc{kQuarter, {0, 0, 1}, {0.5, 0, 0}, true}}, {piece::Line{kStart}}});
  REQUIRE(pieces.size() == 3);
  for (std::size_t i = 1; i < 3; ++i)
    CHECK(pieces[i].world_from_tip(0).isApprox(pieces[i - 1].world_from_tip(1), 1e-12));
  CHECK((pieces[0].world_from_tip(0.5).translation() - Vector3(0.5, 0.05, 0.3)).norm() < 1e-12);
  CHECK((pieces[1].world_from_tip(1).translation() - Vector3(0.4, 0, 0.3)).norm() < 1e-12);
  CHECK(pieces[2].world_from_tip(1).isApprox(kStart, 1e-12));
}

TEST_CASE(
    "a piece is made as it was asked for: how fast, whether it stops, what its end is called, how wide the hand is") {
  const Ways ways;
  Piece slow{piece::Offset{{0, 0.1, 0}}};
  slow.speed = 0.03, slow.turn_speed = 0.2, slow.stop = true, slow.name = "edge", slow.opening = 0.05;
  const auto pieces = ways({slow, {piece::Offset{{0, 0, 0.1}}}});
  CHECK(pieces[0].speed == 0.03);
  CHECK(pieces[0].turn_speed == 0.2);
  CHECK(pieces[0].stop);
  CHECK(pieces[0].name == "edge");
  CHECK(pieces[0].opening == 0.05);
  CHECK(pieces[1].speed == 0.25);
  CHECK_FALSE(pieces[1].stop);
  CHECK(pieces[1].name.empty());
  CHECK_FALSE(pieces[1].opening);
}

TEST_CASE("an arc keeps its distance, and turns the tool with it or not") {
  const Ways ways;
  for (const bool turn : {true, false}) {
    const auto pieces = ways({{piece::Arc{kQuarter, {0, 0, 1}, {0.4, 0, 0}, turn}}});
    for (const double share : {0.3, 0.7, 1.0}) {
      const Transform tip = pieces[0].world_from_tip(share);
      CHECK((tip.translation() - Vector3(0.4, 0, 0.3)).norm() == Approx(0.1));
      CHECK(turn_between(tip, kStart) == Approx(turn ? share * kQuarter : 0).margin(1e-7));
    }
    CHECK((pieces[0].world_from_tip(1).translation() - Vector3(0.4, 0.1, 0.3)).norm() < 1e-12);
  }
}

TEST_CASE("a tilt about the tip leaves it where it is, about a point of the tool or the world that point stays") {
  const Ways ways;
  const Transform own = ways.end({{piece::Tilt{1.2, {1, 0, 0}, {0, 0, 0}, false}}});
  CHECK((own.translation() - kStart.translation()).norm() < 1e-12);
  CHECK(turn_between(own, kStart) == Approx(1.2));
  // The tool's z points down: a turn about its x by a quarter turns z from -world z to +world y or back.
  CHECK((own.linear().col(0) - kStart.linear().col(0)).norm() < 1e-12);
  const Vector3 rim(0, 0.03, 0.05);
  const Transform about_rim = ways.end({{piece::Tilt{1.2, {1, 0, 0}, rim, false}}});
  CHECK((about_rim * rim - kStart * rim).norm() < 1e-12);
  CHECK((about_rim.translation() - kStart.translation()).norm() == Approx(2 * std::sin(0.6) * rim.norm()));
  const Vector3 lip(0.5, 0.1, 0.25);
  const Transform about_lip = ways.end({{piece::Tilt{-0.5, {0, 1, 0}, lip, true}}});
  CHECK((about_lip * (kStart.inverse() * lip) - lip).norm() < 1e-12);
}

TEST_CASE("the tool's axis is the one that it has when the piece begins") {
  const Ways ways;
  const Transform turned = ways.end(
      {{piece::Arc{kQuarter, {0, 0, 1}, kStart.translation(), true}}, {piece::Tilt{0.7, {1, 0, 0}, {0, 0, 0}, false}}});
  // Its x is the world's y by then.
  const Transform expected = translation(kStart.translation()) * Eigen::AngleAxisd(0.7, Vector3::UnitY()) *
                             Eigen::AngleAxisd(kQuarter, Vector3::UnitZ()) *
                             translation(Vector3(-kStart.translation())) * kStart;
  CHECK(turned.isApprox(expected, 1e-12));
}

TEST_CASE("what a follow is made on, and whether it moves the fingers") {
  Follow call;
  call.pieces = {{piece::Offset{{0, 0, 0.1}}}};
  CHECK(yielding(call) == Yielding::no);
  CHECK_FALSE(moves_fingers(call));
  call.most_force = 10;
  CHECK(yielding(call) == Yielding::where_stiff);
  call.press = 5;
  CHECK(yielding(call) == Yielding::always);
  call.pieces[0].opening = 0.04;
  CHECK(moves_fingers(call));
  MoveLine line;
  line.search = 0.004;
  CHECK(yielding(line) == Yielding::always);
}
