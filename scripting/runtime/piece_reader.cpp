#include "scripting/runtime/piece_reader.h"

#include "engine/base/error.h"
#include "scripting/lua/binding.h"
#include "scripting/runtime/options.h"

namespace stampede {
namespace {

namespace piece = robot_call::piece;
using robot_call::Piece;

constexpr double kMostAngle = 50;  // rad: what goes round more often is a mistake

// What a piece turns about, as it is written.
struct About {
  enum class Kind { none, numbers, pose, thing } kind = Kind::none;
  Vector3 point = Vector3::Zero();  // of numbers; else where it is in the world
  std::string thing;
};

class PieceReader {
 public:
  PieceReader(lua_State* state, const WorldView& view, std::string place)
      : state_(state), view_(view), place_(std::move(place)) {}

  // The table at `index`, which is absolute. `otherwise`: what the options say for all pieces.
  Piece read(int index, const Piece& otherwise) const {
    Piece piece = otherwise;
    piece.speed = number_field(state_, index, "speed", piece.speed, place_);
    piece.turn_speed = number_field(state_, index, "turn_speed", piece.turn_speed, place_);
    if (!(piece.speed > 0) || !(piece.turn_speed > 0)) fail("speed and turn_speed must be positive");
    piece.stop = flag_field(state_, index, "stop");
    piece.opening = opening_field(state_, index, view_.scene().robot.opening_max, place_);
    if (has_field(state_, index, "name")) {
      lua_getfield(state_, index, "name");
      if (lua_type(state_, -1) != LUA_TSTRING) fail("name must be text");
      piece.name = lua_tostring(state_, -1);
      lua_pop(state_, 1);
    }
    set_way(index, piece);
    return piece;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(place_, what); }

  void set_way(int index, Piece& piece) const {
    int ways = 0;
    for (const char* way : {"to", "by", "arc", "tilt"}) ways += has_field(state_, index, way) ? 1 : 0;
    if (ways > 1) fail("it has several of to, by, arc and tilt: make each a piece of its own");
    if (ways == 0 && !piece.opening) fail("it goes nowhere: it needs to, by, arc, tilt or open");
    const bool turns = has_field(state_, index, "arc") || has_field(state_, index, "tilt");
    for (const char* word : {"axis", "about", "turn"})
      if (!turns && has_field(state_, index, word)) fail(std::string(word) + " belongs to an arc or a tilt");
    if (has_field(state_, index, "to")) {
      lua_getfield(state_, index, "to");
      piece.way = piece::Line{pose_at(lua_gettop(state_), "to")};
      lua_pop(state_, 1);
    } else if (has_field(state_, index, "by")) {
      lua_getfield(state_, index, "by");
      piece.way = piece::Offset{vector_at(state_, lua_gettop(state_), "by", place_)};
      lua_pop(state_, 1);
    } else if (has_field(state_, index, "arc")) {
      set_arc(index, piece);
    } else if (has_field(state_, index, "tilt")) {
      set_tilt(index, piece);
    }
  }

  Transform pose_at(int index, const char* word) const {
    if (lua_type(state_, index) != LUA_TUSERDATA) fail(std::string(word) + " must be a pose");
    const Transform pose = check_pose(state_, index);
    if (!pose.matrix().allFinite()) fail(std::string(word) + " must be finite");
    return pose;
  }

  double angle(int index, const char* word) const {
    const double angle = number_field(state_, index, word, 0, place_);
    if (angle == 0 || std::abs(angle) > kMostAngle) fail(std::string(word) + " must be an angle in rad, not 0");
    return angle;
  }

  About about(int index) const {
    About about;
    lua_getfield(state_, index, "about");
    const int top = lua_gettop(state_);
    if (lua_type(state_, top) == LUA_TSTRING) {
      about.kind = About::Kind::thing;
      about.thing = check_text(state_, top);
      about.point = view_.world_from(about.thing).translation();
    } else if (lua_istable(state_, top)) {
      about.kind = About::Kind::numbers;
      about.point = vector_at(state_, top, "about", place_);
    } else if (!lua_isnil(state_, top)) {
      about.kind = About::Kind::pose;
      about.point = pose_at(top, "about").translation();
    }
    lua_pop(state_, 1);
    return about;
  }

  void set_arc(int index, Piece& piece) const {
    const double turn = angle(index, "arc");
    const About centre = about(index);
    const bool carries = flag_field(state_, index, "turn", true);
    if (centre.kind == About::Kind::none)
      fail("an arc needs about: a pose, { x, y, z }, a thing, or a part that has a joint");
    const Vector3 axis = direction_field(state_, index, "axis", place_);
    if (!axis.isZero()) {
      piece.way = piece::Arc{turn, axis.normalized(), centre.point, carries};
      return;
    }
    if (centre.kind != About::Kind::thing) fail("an arc about a point needs axis = { x, y, z }");
    if (joint_of(view_, centre.thing, place_).kind == JointKind::slider)
      fail("'" + centre.thing + "' slides and does not turn: use by, or robot:move_part");
    piece.way = piece::PartArc{turn, centre.thing, carries};
  }

  void set_tilt(int index, Piece& piece) const {
    piece::Tilt tilt;
    tilt.angle = angle(index, "tilt");
    if (has_field(state_, index, "turn")) fail("turn belongs to an arc: a tilt turns the tool");
    const Vector3 axis = direction_field(state_, index, "axis", place_);
    tilt.axis = axis.isZero() ? Vector3::UnitZ() : axis.normalized();
    const About centre = about(index);
    tilt.point = centre.point;
    tilt.in_world = centre.kind == About::Kind::pose || centre.kind == About::Kind::thing;
    if (centre.kind == About::Kind::thing && carried(centre.thing)) {
      tilt.point = view_.world_from_tip().inverse() * centre.point;
      tilt.in_world = false;
    }
    piece.way = tilt;
  }

  bool carried(const std::string& thing) const {
    const std::string held = view_.grasped_object();
    return !held.empty() && view_.object(held).body == view_.object(thing).body;
  }

  lua_State* state_;
  const WorldView& view_;
  std::string place_;
};

// The options at index 3, and what they say for all pieces.
robot_call::Follow read_options(lua_State* state, Piece& all) {
  robot_call::Follow call;
  all.speed = number_field(state, 3, "speed", all.speed);
  all.turn_speed = number_field(state, 3, "turn_speed", all.turn_speed);
  luaL_argcheck(state, all.speed > 0 && all.turn_speed > 0, 3, "speed and turn_speed must be positive");
  call.blend = number_field(state, 3, "blend", call.blend);
  call.most_force = number_field(state, 3, "most_force", 0);
  call.press = number_field(state, 3, "press", 0);
  luaL_argcheck(state, call.blend >= 0 && call.most_force >= 0 && call.press >= 0, 3,
                "blend, most_force and press must not be negative");
  call.press_along = direction_field(state, 3, "press_along");
  call.keep_clear = flag_field(state, 3, "keep_clear");
  call.tolerate = flag_field(state, 3, "tolerate");
  return call;
}

}  // namespace

std::vector<Piece> pieces_at(lua_State* state, int index, const WorldView& view, const Piece& all) {
  luaL_checktype(state, index, LUA_TTABLE);
  std::vector<Piece> pieces;
  const auto count = static_cast<lua_Integer>(lua_rawlen(state, index));
  luaL_argcheck(state, count > 0, index, "expected a list of pieces: { { to = pose }, { by = { x, y, z } }, … }");
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(state, index, i);
    const int at = lua_gettop(state);
    const std::string place = "piece " + std::to_string(i);
    if (!lua_istable(state, at)) throw Error(place, "expected a table such as { by = { 0, 0, 0.1 } }");
    only_fields(state, at,
                {"to", "by", "arc", "tilt", "axis", "about", "turn", "speed", "turn_speed", "stop", "name", "open"},
                place, "field");
    pieces.push_back(PieceReader(state, view, place).read(at, all));
    lua_settop(state, at - 1);
  }
  return pieces;
}

robot_call::Follow follow_at(lua_State* state, const WorldView& view) {
  luaL_checktype(state, 2, LUA_TTABLE);
  only_fields(state, 3,
              {"speed", "turn_speed", "blend", "most_force", "press", "press_along", "keep_clear", "tolerate"});
  Piece all;
  robot_call::Follow call = read_options(state, all);
  call.pieces = pieces_at(state, 2, view, all);
  return call;
}

robot_call::Follow tilt_at(lua_State* state, const WorldView& view) {
  only_fields(state, 3,
              {"axis", "about", "name", "open", "speed", "turn_speed", "blend", "most_force", "press", "press_along",
               "keep_clear", "tolerate"});
  Piece all;
  robot_call::Follow call = read_options(state, all);
  const double angle = finite(state, 2);
  lua_newtable(state);
  lua_pushnumber(state, angle);
  lua_setfield(state, -2, "tilt");
  const int at = lua_gettop(state);
  for (const char* field : {"axis", "about", "name", "open"}) {
    if (!has_field(state, 3, field)) continue;
    lua_getfield(state, 3, field);
    lua_setfield(state, at, field);
  }
  call.pieces.push_back(PieceReader(state, view, "").read(at, all));
  return call;
}

}  // namespace stampede
