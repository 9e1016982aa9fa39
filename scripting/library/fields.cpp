#include "scripting/library/fields.h"

// One row a field: name, type, required, default, unit, description, example, may be a function of the variation.
namespace stampede {
namespace {

const Record kTask{
    "task",
    "What is to be done: objects, how they start, what must be true at the end",
    {{"world", "string", true, "", "", "the world file it takes place in", "\"tabletop\""},
     {"variations", "table|table[]", false, "{}", "", "axes (their product) or an explicit list of variations",
      "{ height = { 2, 3 }, colour = colours.names }"},
     {"where", "function", false, "", "", "function(v): false leaves a combination of the axes out"},
     {"objects", "{entry}", false, "{}", "", "the objects by name; count = n makes name1 … namen",
      "{ block = { \"cube\", count = 4 } }", true},
     {"init", "formula[]|formula", false, "{}", "", "what holds at the start, in the order in which it is made true",
      "{ is.on(\"block*\", \"table\") }", true},
     {"goal", "formula|formula[]", true, "", "", "what must hold at the end", "is.on(\"cup\", \"shelf\")", true},
     {"steps", "call[]|call", false, "", "", "the skills to execute, instead of a plan", "{ act.pick(\"cup\") }", true},
     {"also", "function", false, "", "", "function(w): a further test beside the goal"},
     {"fails", "function", false, "", "", "function(w): true ends the episode as failed"},
     {"reward", "function", false, "", "", "function(w): a shaped reward, added to 1 at success"},
     {"subgoals", "table", false, "{}", "", "formulas by name, or a list of { \"name\", formula } in order",
      "{ open_it = is.open(\"chest.top_drawer\") }", true},
     {"horizon", "number", false, "120", "s", "the longest an episode may take", "60", true},
     {"hold", "number", false, "1.0", "s", "for how long the goal must stay true at the end", "0.2", true},
     {"instructions", "string[]|string", true, "", "", "sentences; {axis} is the variation's value",
      "{ \"stack {height} blocks\" }", true}}};

const Record kEntry{
    "entry",
    "One line of a task's objects or a world's fixtures: a class and what differs from its file",
    {{"count", "integer", false, "", "", "makes a group name1 … namen (0: an empty one)", "4"},
     {"at", "vector", false, "", "m", "fixed position of the body in the world", "{ 0.1, 0, 0.75 }"},
     {"yaw", "number", false, "0", "rad", "turn about the vertical", "deg(90)"},
     {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "orientation about fixed axes, instead of yaw"},
     {"quaternion", "numbers", false, "", "", "orientation x y z w, instead of yaw"},
     {"joints", "table", false, "{}", "rad or m", "initial joint positions by part", "{ top_drawer = 0.1 }"}},
    "string"};

const Record kSkill{
    "skill",
    "A parameterised action: when it may be done, what it brings about, and how",
    {{"params", "string[]", true, "", "", "\"name: type & trait\"; the hand is appended by itself",
      "{ \"obj: movable\" }"},
     {"precondition", "formula[]|formula", false, "{}", "", "what must hold before", "{ is.hand_empty() }"},
     {"effect", "effect[]|effect", false, "{}", "", "what holds afterwards; tested after each run",
      "{ is.holding(\"obj\") }"},
     {"cases", "{case}", false, "", "", "instead of precondition and effect: several operators that share run"},
     {"continuous", "table", false, "{}", "",
      "continuous parameters by name: a number or vector with min max unit, or a stream",
      "{ height = { 0.1, min = 0.02, max = 0.3, unit = \"m\" }, grasp = stream(\"grasps\") }"},
     {"controller", "string", false, "\"joint_position\"", "",
      "joint_position, joint_impedance or cartesian_impedance"},
     {"stiffness", "number", false, "0", "N/m or N m/rad", "of an impedance controller; 0: its default"},
     {"label", "string", true, "", "", "what it does in words, with {params}", "\"pick up the {obj}\""},
     {"run", "function", true, "", "", "function(robot, p, c): p parameters, c continuous parameters"},
     {"forgets", "string[]", false, "{}", "", "predicates that contact leaves uncertain", "{ \"on\" }"},
     {"cost", "integer", false, "1", "", "of the action in a plan"},
     {"may_equal", "string[][]", false, "{}", "", "pairs of parameters that may be one object",
      "{ { \"from\", \"to\" } }"}}};

const Record kCase{"case",
                   "One operator of a skill with several",
                   {{"precondition", "formula[]|formula", false, "{}", "", "what must hold before"},
                    {"effect", "effect[]|effect", true, "", "", "what holds afterwards"},
                    {"cost", "integer", false, "1", "", "of this action in a plan"}}};

const Record kPredicate{
    "predicate",
    "A typed symbol with a test on the state of the world",
    {{"params", "string[]", true, "", "", "\"name: type & trait\"; one of type hand may be left out in literals",
      "{ \"obj: movable\", \"surface: surface\" }"},
     {"label", "string", true, "", "", "the fact in words, with {params}", "\"the {obj} is on the {surface}\""},
     {"holds", "function", false, "", "", "function(w, …): does it hold, and a signed margin if there is one"},
     {"derived", "formula", false, "", "", "the formula that it stands for, instead of holds",
      "is_not(exists(\"?y: movable\", is.on(\"?y\", \"x\")))"},
     {"sample", "function", false, "", "", "function(w, …, rng): poses or joint positions that make it true"},
     {"static", "boolean", false, "false", "", "read once, at the start"},
     {"settle", "number", false, "0", "s", "a shorter change is noise"},
     {"momentary", "boolean", false, "false", "", "read at every physics step, without settle time"},
     {"remember", "boolean", false, "false", "", "stays true once true"},
     {"requires", "string", false, "\"all\"", "", "evaluate only pairs that are \"touching\" or \"near\""},
     {"mutex", "string[]", false, "{}", "", "predicates that cannot hold of the same first argument"},
     {"functional", "boolean|string", false, "false", "", "at most one value of the last (or named) parameter"},
     {"observable", "function|boolean", false, "true", "", "function(w, …): can it be seen"},
     {"margin_unit", "string", false, "", "", "unit of the margin", "\"m\""}}};

const std::vector<Field> kBodyFields = {
    {"type", "string", false, "", "", "its class in the type tree of worlds/types.lua", "\"cube\""},
    {"traits", "string[]", false, "{}", "", "what can be done with it", "{ \"movable\", \"graspable\" }"},
    {"shape", "shape", false, "", "", "its one shape", "box { 0.04, 0.04, 0.04 }"},
    {"shapes", "shape[]", false, "{}", "", "its shapes, convex each", "{ box { 0.1, 0.1, 0.02 } }"},
    {"mass", "number", false, "0", "kg", "of the whole body or part"},
    {"friction", "number", false, "0.5", "", "Coulomb coefficient; a pair's is the product of both"},
    {"rolling", "number", false, "0.001", "m", "rolling friction"},
    {"spinning", "number", false, "0.001", "m", "friction about the contact normal"},
    {"restitution", "number", false, "0", "", "bounce, 0 … 1"},
    {"colour", "colour", false, "", "", "of every shape that has none; a name is an attribute too", "\"red\""},
    {"attributes", "table", false, "{}", "", "static facts: texts by name", "{ material = \"wood\" }"},
    {"numbers", "table", false, "{}", "", "numbers by name for predicates: w:number(obj, \"open_at\")",
     "{ open_at = 0.15 }"},
    {"regions", "{region}", false, "{}", "", "named boxes fixed to it, without mass"},
    {"grasps", "grasp[]", false, "{}", "", "where a hand may take it; none: from its geometry"},
    {"size", "vector|numbers|number", false, "", "m", "edge lengths where a file builds its shape from them"},
    {"scale", "number|vector", false, "1", "", "of its meshes"}};

std::vector<Field> body_fields_and(std::vector<Field> more) {
  more.insert(more.begin(), kBodyFields.begin(), kBodyFields.end());
  return more;
}

const Record kObject{
    "object", "A thing: shape, mass, type, traits, parts, grasps",
    body_fields_and({{"fixed", "boolean", false, "not movable", "", "stands still (furniture)"},
                     {"region", "region", false, "", "", "the whole object is a region: no mass, no contact"},
                     {"parts", "{part}", false, "{}", "", "articulated parts, addressed object.part"},
                     {"urdf", "string", false, "", "", "a URDF file beside this one, instead of shapes"}})};

const Record kPart{
    "part", "A moving part of an object",
    body_fields_and({{"parent", "string", false, "the base", "", "the part that it hangs on"},
                     {"slider", "joint", false, "", "", "moves along an axis"},
                     {"hinge", "joint", false, "", "", "turns about an axis"},
                     {"fixed", "joint|boolean", false, "", "", "does not move relative to its parent"}})};

const Record kJoint{"joint",
                    "How a part moves",
                    {{"axis", "vector", false, "{ 0, 0, 1 }", "", "in the joint's frame"},
                     {"at", "vector", false, "{ 0, 0, 0 }", "m", "origin in the parent's frame"},
                     {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "orientation in the parent's frame"},
                     {"yaw", "number", false, "0", "rad", "instead of rpy"},
                     {"range", "range", false, "", "rad or m", "lower and upper limit", "{ 0, 0.2 }"},
                     {"initial", "number", false, "0", "rad or m", "position at the start"},
                     {"damping", "number", false, "0", "N m s or N s/m", "torque or force per speed"},
                     {"friction", "number", false, "0", "N m or N", "greatest friction"},
                     {"spring", "number", false, "0", "N m or N", "constant force back to spring_target"},
                     {"spring_target", "number", false, "0", "rad or m", "where the spring pushes to"},
                     {"detent", "number", false, "0", "N m or N", "holds at a limit until this is exceeded"},
                     {"latch", "latch", false, "", "", "locked until another joint is moved"}}};

const Record kLatch{"latch",
                    "A lock that another part opens",
                    {{"key", "string", true, "", "", "the part whose joint unlocks this one"},
                     {"open", "number", true, "", "rad or m", "the key's position that unlocks"},
                     {"close", "number", false, "0", "rad or m", "locks again below this position"}}};

const Record kRegion{"region",
                     "A named box without mass or contact",
                     {{"at", "vector", false, "{ 0, 0, 0 }", "m", "its centre"},
                      {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "its orientation"},
                      {"yaw", "number", false, "0", "rad", "instead of rpy"},
                      {"size", "vector", true, "", "m", "full edge lengths"},
                      {"type", "string", false, "\"region\"", "", "its class in the type tree"},
                      {"traits", "string[]", false, "{}", "", "what can be done with it"},
                      {"attributes", "table", false, "{}", "", "static facts"},
                      {"numbers", "table", false, "{}", "", "numbers by name"},
                      {"visible", "boolean", false, "false", "", "drawn in pictures"},
                      {"colour", "colour", false, "", "", "when visible"}}};

const Record kGrasp{"grasp",
                    "Where a hand may take an object",
                    {{"at", "vector", false, "{ 0, 0, 0 }", "m", "tool centre point in the object's frame"},
                     {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "z out of the hand, y along the closing axis"},
                     {"yaw", "number", false, "0", "rad", "instead of rpy"},
                     {"quaternion", "numbers", false, "", "", "instead of rpy"},
                     {"width", "number", false, "0.04", "m", "opening at contact"},
                     {"approach", "number", false, "0.08", "m", "way of the straight approach"},
                     {"force", "number", false, "20", "N", "of the fingers"}}};

const Record kShape{"shape",
                    "box { x, y, z }  sphere { r }  cylinder { r, length }  capsule { r, length }  cone { r, length }  "
                    "hull { points }  lathe { { r, z }, … }  mesh { \"file\" }",
                    {{"tag", "string", true, "", "", "set by the words"},
                     {"shape", "string", true, "", "", "set by the words"},
                     {"line", "integer", false, "", "", "set by the words"},
                     {"at", "vector", false, "{ 0, 0, 0 }", "m", "in the part's frame"},
                     {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "in the part's frame"},
                     {"yaw", "number", false, "0", "rad", "instead of rpy"},
                     {"quaternion", "numbers", false, "", "", "instead of rpy"},
                     {"colour", "colour", false, "", "", "of this shape"},
                     {"collides", "boolean", false, "true", "", "touches others"},
                     {"visible", "boolean", false, "true", "", "is drawn"},
                     {"scale", "number|vector", false, "1", "", "of a mesh file"},
                     {"segments", "integer", false, "16", "", "wedges of a lathe"}},
                    "any"};

const Record kWorld{
    "world",
    "Where tasks take place: robot, fixtures, cameras, sensors, light",
    {{"robot", "entry", true, "", "", "the robot file and where it stands", "{ \"panda\", at = { -0.3, 0, 0.75 } }"},
     {"fixtures", "{entry}", false, "{}", "", "objects that every task has", "{ table = { \"work_table\" } }"},
     {"cameras", "{camera}", false, "{}", "", "by name"},
     {"sensors", "{sensor}", false, "{}", "", "by name"},
     {"light", "table", false, "{}", "", "direction, ambient, diffuse"},
     {"regions", "{region}", false, "{}", "", "fixed to the world"},
     {"gravity", "vector", false, "{ 0, 0, -9.81 }", "m/s^2", ""},
     {"physics_hz", "integer", false, "240", "Hz", "physics and control"},
     {"frame_hz", "integer", false, "20", "Hz", "recorded frames; divides physics_hz"}}};

const Record kCamera{"camera",
                     "Where pictures are taken from",
                     {{"at", "vector", true, "", "m", "position, in the world or on its mount"},
                      {"look_at", "string|vector", false, "", "", "an object of the world or a point"},
                      {"rpy", "vector", false, "", "rad", "instead of look_at"},
                      {"quaternion", "numbers", false, "", "", "instead of look_at"},
                      {"up", "vector", false, "{ 0, 0, 1 }", "", "which way is up in the picture"},
                      {"mount", "string", false, "", "", "what it moves with", "\"robot.hand\""},
                      {"fov", "number", false, "deg(40)", "rad", "vertical field of view"},
                      {"size", "size", false, "{ 128, 128 }", "pixels", "width and height"},
                      {"near", "number", false, "0.01", "m", ""},
                      {"far", "number", false, "4.5", "m", ""}}};

const Record kSensor{"sensor",
                     "Something measured beside the frames",
                     {{"on", "string", false, "", "", "where it sits", "\"robot.wrist\""},
                      {"rate", "number", false, "", "Hz", "divides the physics rate"}},
                     "string"};

const Record kRobot{
    "robot",
    "What a URDF cannot say about an arm",
    {{"urdf", "string", true, "", "", "the URDF file beside this one", "\"panda.urdf\""},
     {"arm", "string[]", true, "", "", "its driven joints from base to tip"},
     {"tip", "table", true, "", "m, rad", "the tool centre point: link, at, rpy",
      "{ link = \"hand\", at = { 0, 0, 0.1034 } }"},
     {"home", "numbers", true, "", "rad", "where every episode starts"},
     {"fingers", "string[]", false, "{}", "", "two sliding joints, coupled"},
     {"pads", "string[]", false, "{}", "", "the links whose contact counts as touch"},
     {"limits", "table", false, "{}", "rad/s …", "numbers or one per joint: velocity, acceleration, jerk, effort"},
     {"velocity", "numbers", false, "", "rad/s", "limits, one per joint; more than the URDF says is cut"},
     {"acceleration", "numbers", false, "", "rad/s^2", "limits, one per joint"},
     {"jerk", "numbers", false, "", "rad/s^3", "limits, one per joint"},
     {"effort", "numbers", false, "", "N m", "limits, one per joint"},
     {"checked_pairs", "string[][]", false, "", "", "the same as checked"},
     {"allowed_pairs", "string[][]", false, "", "", "the same as allowed"},
     {"pad", "table", false, "{}", "", "surface of the pads: friction, rolling, spinning, anchor"},
     {"allowed", "string[][]", false, "{}", "", "pairs of links that never meet"},
     {"checked", "string[][]", false, "", "", "pairs of links that are tested for collision; instead of allowed"},
     {"opening", "number", false, "0.08", "m", "both fingers together"},
     {"grip_force", "number", false, "20", "N", "of the fingers"},
     {"finger_speed", "number", false, "0.1", "m/s", "of each finger"},
     {"hand", "string", false, "\"hand\"", "", "name of its hand: ROBOT.hand"},
     {"pad_friction", "number", false, "", "", "Coulomb coefficient of the pads"},
     {"colours", "table", false, "{}", "", "colours by link"}}};

}  // namespace

const std::vector<Record>& records() {
  static const std::vector<Record> kRecords = {kTask, kSkill, kPredicate, kObject, kWorld, kRobot, kEntry,  kCase,
                                               kPart, kJoint, kLatch,     kRegion, kGrasp, kShape, kCamera, kSensor};
  return kRecords;
}

const Record* record(std::string_view name) {
  for (const Record& candidate : records()) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
}

std::vector<std::string> field_names(const Record& record) {
  std::vector<std::string> names;
  for (const Field& field : record.fields) names.emplace_back(field.name);
  return names;
}

}  // namespace stampede
