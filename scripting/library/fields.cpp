#include "scripting/library/fields.h"

// One row a field: name, type, required, default, unit, description, example, may be a function of the variation.
namespace stampede {
namespace {

const Record kTask{
    "task",
    "What is to be done: objects, how they start, what must be true at the end",
    {{"world", "string", false, "\"tabletop\"", "", "the world file it takes place in", "\"kitchen\""},
     {"variations", "table|table[]", false, "{}", "", "axes (their product) or an explicit list of variations",
      "{ height = { 2, 3 }, colour = colours.names }"},
     {"where", "function", false, "", "", "function(v): false leaves a combination of the axes out"},
     {"objects", "{entry}", false, "{}", "", "the objects by name; count = n makes name1 … namen",
      "{ block = { \"cube\", count = 4 } }", true},
     {"init", "formula[]|formula", false, "{}", "",
      "what holds at the start, in the order in which it is made true; formulas such as exists are met by drawing",
      "{ is.on(\"block*\", \"table\") }", true},
     {"told", "formula[]|formula", false, "{}", "",
      "facts of the start that the sentences tell, where nobody can see them: plans need not search",
      "{ is.inside(\"cup\", \"cupboard.top_shelf\") }", true},
     {"goal", "formula|formula[]", true, "", "", "what must hold at the end", "is.on(\"cup\", \"shelf\")", true},
     {"observable", "table", false, "{}", "",
      "by predicate, what of its facts can be seen here, beside what its file says: function(w, …), or false: nothing",
      "{ on = function(w, obj) return not w:exists(\"lid\") end }"},
     {"hand", "string", false, "empty", "",
      "at the end: empty, or any; what the goal says of the hand or of things held goes before it", "\"any\""},
     {"skills", "string[]", false, "{}", "", "skills that extend or replace others, for this task", "{ \"my_open\" }"},
     {"steps", "call[]|call", false, "", "", "the skills to execute, instead of a plan", "{ act.pick(\"cup\") }", true},
     {"also", "function", false, "", "", "function(w, v): a further test beside the goal"},
     {"fails", "function", false, "", "",
      "function(w, v): true ends the episode as failed, for the reason failed_by_task"},
     {"reward", "function", false, "", "", "function(w, v): a shaped reward, added to 1 at success"},
     {"subgoals", "table", false, "{}", "",
      "formulas by name, or a list in order of { \"name\", formula } or { \"name\", formula, \"sentence\" }; {axis} in "
      "it is "
      "the variation's value",
      "{ { \"open_it\", is.open(\"chest.top_drawer\"), \"open the drawer\" } }", true},
     {"horizon", "number", false, "120", "s", "the longest an episode may take", "60", true},
     {"observe", "observe", false, "{}", "", "pictures and sensors to record; goes before the world's, field by field"},
     {"hold", "number", false, "1.0", "s", "for how long the goal must stay true at the end", "0.2", true},
     {"instructions", "string[]|string", true, "", "", "sentences; {axis} is the variation's value",
      "{ \"stack {height} blocks\" }", true},
     {"problem", "problem", false, "", "", "what `stampede import` made it from: its episodes are judged by it too"}}};

const Record kProblem{
    "problem",
    "The problem of another language that a task was imported from",
    {{"dialect", "string", true, "", "", "whose words it is in: libero or behavior", "\"libero\""},
     {"text", "string", true, "", "", "the whole problem, as that language writes it", "[[(define (problem …) …)]]"},
     {"mapping", "string", false, "the dialect's", "", "a file of worlds/bddl by name: our words for its words"},
     {"names", "table", false, "{}", "", "its names, and ours where a thing has another one here",
      "{ main_table = \"table\" }"}}};

const Record kEntry{
    "entry",
    "One line of a task's objects or a world's fixtures: a class and what differs from its file",
    {{"count", "integer", false, "", "", "makes a group name1 … namen (0: an empty one)", "4"},
     {"at", "vector|on_table", false, "", "m", "fixed position of the body in the world", "on_table { 0.1, 0 }"},
     {"yaw", "number", false, "0", "rad", "turn about the vertical", "deg(90)"},
     {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "orientation about fixed axes, instead of yaw"},
     {"quaternion", "numbers", false, "", "", "orientation x y z w, instead of yaw"},
     {"joints", "table", false, "{}", "rad or m",
      "initial joint positions by part; of a robot, where its arm starts instead of at home",
      "{ top_drawer = between(0.08, 0.14) }"}},
    "string"};

const Record kPlace{"place",
                    "Where something stands",
                    {{"at", "vector|on_table", true, "", "m", "position of the body in the world"},
                     {"yaw", "number", false, "0", "rad", "turn about the vertical"},
                     {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "orientation about fixed axes, instead of yaw"},
                     {"quaternion", "numbers", false, "", "", "orientation x y z w, instead of yaw"}}};

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
     {"verbs", "string[]", false, "its label's", "", "that tell of it in sentences, the first its own",
      "{ \"take\", \"lift\" }"},
     {"reads", "{declared_number}", false, "{}", "",
      "numbers of its things that it reads, beside those of their traits",
      "{ depth = { \"how far it goes down\", of = \"button\", unit = \"m\", default = 0.01 } }"},
     {"run", "function", true, "", "", "function(robot, p, c): p parameters, c continuous parameters"},
     {"forgets", "string[]", false, "{}", "", "predicates that contact leaves uncertain", "{ \"on\" }"},
     {"cost", "integer", false, "1", "", "of the action in a plan"},
     {"moves", "string[]", false, "{}", "", "parameters that it moves: what ends_when \"moved\" of them ends",
      "{ \"obj\" }"},
     {"extends", "string", false, "", "",
      "a skill whose fields it has where it gives none itself; conditions and effects add up. It takes that one's "
      "place "
      "in tasks and worlds that name it in their skills",
      "\"pick\""},
     {"replaces", "string", false, "", "",
      "a skill whose place it takes in tasks and worlds that name it in their skills", "\"open\""},
     {"may_equal", "string[][]", false, "{}", "", "pairs of parameters that may be one object",
      "{ { \"from\", \"to\" } }"}}};

const Record kDeclaredNumber{
    "declared_number",
    "A number that things can have, for w:number: what it says, its unit and what is read of things without it",
    {{"of", "string|string[]", false, "", "", "the parameters whose things have it", "\"box\""},
     {"unit", "string", false, "\"\"", "", "m, rad, m or rad, s, kg, N, N m, or none: a count"},
     {"default", "number", false, "", "unit", "of things without it; none: they must have it"},
     {"optional", "boolean", false, "false", "", "of things without it nil is read"},
     {"min", "number", false, "", "unit", "the least that makes sense"},
     {"max", "number", false, "", "unit", "the greatest"}},
    "string"};

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
     {"holds", "function", false, "", "",
      "function(w, …): does it hold, and a signed margin if there is one: not negative exactly while it holds"},
     {"derived", "formula", false, "", "", "the formula that it stands for, instead of holds",
      "is_not(exists(\"?y: movable\", is.on(\"?y\", \"x\")))"},
     {"reads", "{declared_number}", false, "{}", "",
      "numbers of its things that it reads, beside those of their traits",
      "{ depth = { \"how far it goes down\", of = \"button\", unit = \"m\", default = 0.01 } }"},
     {"sample", "function", false, "", "", "function(w, …, rng): poses or joint positions that make it true"},
     {"static", "boolean", false, "false", "", "cannot change in an episode: read once, at the start"},
     {"start_only", "boolean", false, "false", "",
      "a condition for init and --where, tested when a start is drawn; never a fact, so no goal or skill names it"},
     {"extends", "string", false, "", "",
      "a predicate whose fields it has where it gives none itself; it holds where that one holds and its own test too",
      "\"on\""},
     {"settle", "number", false, "0", "s", "a shorter change is noise"},
     {"momentary", "boolean", false, "false", "", "read at every physics step, without settle time"},
     {"remember", "boolean", false, "false", "", "stays true once true"},
     {"ends_when", "string", false, "", "",
      "\"moved\": it ends when a skill moves one of its things, also one that knows nothing of it", "\"moved\""},
     {"only_named", "boolean", false, "false", "",
      "followed, and so a fact, in those tasks alone that name it: in a formula, or in a function as a text"},
     {"made_by", "string[]", false, "{}", "",
      "skills that make it true by where they put its first thing, when the goal asks for it; what moves one of its "
      "things ends it",
      "{ \"place\" }"},
     {"requires", "string", false, "\"all\"", "",
      "what can hold at all: pairs that are \"touching\" or \"near\"; \"held\": the last is in the hand"},
     {"mutex", "string[]", false, "{}", "",
      "predicates that cannot hold of the same first argument: no start is drawn with both"},
     {"functional", "boolean|string", false, "false", "",
      "at most one value of the last (or named) parameter: no start is drawn with two"},
     {"observable", "function|boolean", false, "true", "",
      "function(w, …): can one see now whether it holds; false: never"},
     {"margin_unit", "string", false, "", "",
      "unit of the margin; channel `margins` is of the predicates that say one; \"m or rad\": the joint's", "\"m\""}}};

const std::vector<Field> kBodyFields = {
    {"type", "string", false, "", "", "its class in the type tree of worlds/types.lua", "\"cube\""},
    {"nouns", "string", false, "\"\"", "", "what else it is called in sentences, beside its own name and its types'",
     "\"mug beaker\""},
    {"traits", "string[]", false, "{}", "", "what can be done with it", "{ \"movable\", \"graspable\" }"},
    {"shape", "shape", false, "", "", "its one shape", "box { 0.04, 0.04, 0.04 }"},
    {"shapes", "shape[]", false, "{}", "", "its shapes, convex each", "{ box { 0.1, 0.1, 0.02 } }"},
    {"visual", "shape|shape[]", false, "", "", "what is drawn instead of shapes, which then only collide",
     "mesh { \"cup.glb\" }"},
    {"mass", "number", false, "0", "kg", "of the whole body or part"},
    {"friction", "number", false, "0.5", "", "Coulomb coefficient; a pair's is the product of both"},
    {"rolling", "number", false, "0.001", "m", "rolling friction"},
    {"spinning", "number", false, "0.001", "m", "friction about the contact normal"},
    {"restitution", "number", false, "0", "", "bounce, 0 … 1"},
    {"colour", "colour", false, "", "", "of every shape that has none; a name is an attribute too", "\"red\""},
    {"texture", "texture", false, "", "", "of every shape that has neither colour nor texture; colour tints it",
     "checker { \"white\", \"black\", size = 0.1 }"},
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
    body_fields_and(
        {{"fixed", "boolean", false, "not movable", "", "stands still (furniture)"},
         {"place", "place", false, "", "",
          "at and a turn together, where one draw chooses both; an entry's at goes before it",
          "one_of { { at = on_table { 0.5, 0 } }, { at = on_table { 0.1, 0.5 }, yaw = deg(90) } }"},
         {"region", "region", false, "", "", "the whole object is a region: no mass, no contact"},
         {"parts", "{part}", false, "{}", "", "articulated parts, addressed object.part"},
         {"urdf", "string", false, "", "", "a URDF file beside this one, instead of shapes"},
         {"tip", "tip", false, "", "", "where a tool acts: the region OBJECT.tip, `{ tool = \"OBJECT\" }` of moves",
          "{ at = { 0, 0, -0.15 }, rpy = { math.pi, 0, 0 } }"},
         {"declares", "table", false, "{}", "",
          "types, traits and numbers of its own, as worlds/types.lua does: { types = {…}, traits = {…}, numbers = {…} "
          "}"}})};

const Record kPart{
    "part", "A moving part of an object",
    body_fields_and({{"parent", "string", false, "the base", "", "the part that it hangs on"},
                     {"slider", "joint", false, "", "", "moves along an axis"},
                     {"hinge", "joint", false, "", "", "turns about an axis"},
                     {"screw", "joint", false, "", "", "turns about an axis and travels along it"},
                     {"fixed", "joint|boolean", false, "", "", "does not move relative to its parent"}})};

const Record kJoint{
    "joint",
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
     {"stiffness", "number", false, "0", "N m/rad or N/m", "force per way from spring_target, beside spring"},
     {"detent", "number", false, "0", "N m or N", "holds at a limit until this is exceeded"},
     {"pitch", "number", false, "", "m", "of a screw: travel in a whole turn; negative: left-handed"},
     {"lets_go", "number", false, "", "rad or m",
      "where the joint lets go of its part, for good; until then that is a thing of its own that is held there"},
     {"follows", "follows", false, "", "", "coupled to another joint; each moves the other"},
     {"latch", "latch", false, "", "", "locked until another joint is moved"}}};

const Record kLatch{"latch",
                    "A lock that another part opens",
                    {{"key", "string", true, "", "", "the part whose joint unlocks this one"},
                     {"open", "number", true, "", "rad or m", "the key's position that unlocks"},
                     {"close", "number", false, "0", "rad or m", "locks again below this position"}}};

const Record kFollows{"follows",
                      "A coupling of two joints of an object: position = ratio * the other's + offset",
                      {{"part", "string", true, "", "", "the part whose joint this one follows"},
                       {"ratio", "number", false, "1", "", "of both positions, such as rad per m"},
                       {"offset", "number", false, "0", "rad or m", "this position where the other is 0"}}};

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

const Record kTip{
    "tip",
    "The point of a tool that acts: z out of the tool, in the direction in which it works",
    {{"at", "vector", false, "{ 0, 0, 0 }", "m", "in the object's frame, on the tool or at most 5 mm off it"},
     {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "in the object's frame"},
     {"yaw", "number", false, "0", "rad", "instead of rpy"},
     {"quaternion", "numbers", false, "", "", "instead of rpy"}}};

const Record kGrasp{"grasp",
                    "Where a hand may take an object",
                    {{"at", "vector", false, "{ 0, 0, 0 }", "m", "tool centre point in the object's frame"},
                     {"rpy", "vector", false, "{ 0, 0, 0 }", "rad", "z out of the hand, y along the closing axis"},
                     {"yaw", "number", false, "0", "rad", "instead of rpy"},
                     {"quaternion", "numbers", false, "", "", "instead of rpy"},
                     {"width", "number", false, "0.04", "m", "opening at contact"},
                     {"approach", "number", false, "0.08", "m", "way of the straight approach"},
                     {"force", "number", false, "20", "N", "of the fingers"}}};

const Record kShape{
    "shape",
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
     {"texture", "texture", false, "", "", "of this shape; its colour tints it"},
     {"collides", "boolean", false, "true", "", "touches others"},
     {"visible", "boolean", false, "true", "", "is drawn"},
     {"shows", "formula", false, "", "",
      "drawn only while this fact of the object (\"self\"), a part or a region of it holds, or does not",
      "is.pressed(\"button\")"},
     {"scale", "number|vector", false, "1", "", "of a mesh file"},
     {"segments", "integer", false, "16", "", "wedges of a lathe"},
     {"wall", "number", false, "", "m", "of a hollow lathe, which collides as wedges"}},
    "any"};

const Record kTexture{"texture",
                      "texture { \"file.png\" }  checker { colour, colour }  stripes { colour, colour }  "
                      "noise { colour, colour }",
                      {{"tag", "string", true, "", "", "set by the words"},
                       {"texture", "string", true, "", "", "set by the words"},
                       {"line", "integer", false, "", "", "set by the words"},
                       {"size", "number", false, "0.1", "m", "of one repeat, along the axes of the shape"},
                       {"seed", "integer", false, "0", "", "of noise"}},
                      "any"};

const Record kWorld{
    "world",
    "Where tasks take place: robot, fixtures, cameras, sensors, light",
    {{"robot", "entry", true, "", "", "the robot file and where it stands", "{ \"panda\", at = { -0.3, 0, 0.75 } }"},
     {"skills", "string[]", false, "{}", "", "skills that extend or replace others, for its tasks", "{ \"my_open\" }"},
     {"fixtures", "{entry}", false, "{}", "", "objects that every task has", "{ table = { \"work_table\" } }"},
     {"cameras", "{camera}", false, "{}", "", "by name"},
     {"calibration", "string", false, "", "",
      "a file beside this one with cameras as they were measured; they replace "
      "those of the same names",
      "\"lab_cameras.json\""},
     {"sensors", "{sensor}", false, "{}", "", "by name",
      "{ wrench = { \"force_torque\", on = \"robot.hand\", rate = 120 } }"},
     {"light", "light", false, "{}", "", "one lamp far away and light from everywhere"},
     {"randomise", "randomise", false, "", "", "what --randomise draws for each episode"},
     {"observe", "observe", false, "{}", "", "pictures and sensors that its episodes record"},
     {"motion", "motion", false, "{}", "", "how its arms find their way"},
     {"regions", "{region}", false, "{}", "", "fixed to the world"},
     {"gravity", "vector", false, "{ 0, 0, -9.81 }", "m/s^2", ""},
     {"physics_hz", "integer", false, "240", "Hz", "physics and control"},
     {"frame_hz", "integer", false, "20", "Hz", "recorded frames; divides physics_hz"}}};

const Record kCamera{
    "camera",
    "Where pictures are taken from. Its own frame: x right, y down, z forward",
    {{"at", "vector", true, "", "m", "position, in the world or on its mount"},
     {"look_at", "string|vector", false, "", "", "an object of the world, or a point of the frame that `at` is in"},
     {"rpy", "vector", false, "", "rad", "of its frame, instead of look_at"},
     {"quaternion", "numbers", false, "", "", "of its frame, x y z w, instead of look_at"},
     {"up", "vector", false, "{ 0, 0, 1 }", "", "which way is up in the picture"},
     {"mount", "string", false, "", "", "what it moves with: an object, or a link of the robot", "\"robot.hand\""},
     {"fov", "number", false, "deg(40)", "rad", "vertical field of view"},
     {"focal", "numbers", false, "", "pixels", "focal lengths { fx, fy }, instead of fov", "{ 600, 600 }"},
     {"centre", "numbers", false, "half the size", "pixels", "where the optical axis meets the picture, { cx, cy }"},
     {"distortion", "numbers", false, "{ 0, 0, 0, 0, 0 }", "", "of the lens (Brown): { k1, k2, p1, p2, k3 }"},
     {"size", "size", false, "{ 128, 128 }", "pixels", "width and height, 1 to 4096"},
     {"near", "number", false, "0.01", "m", "nothing nearer is seen"},
     {"far", "number", false, "4.5", "m", "nothing farther is seen; pictures of depth end at 6.55"}}};

const Record kSensor{"sensor",
                     "Something measured beside the frames: \"force_torque\" or \"joint_torque\"",
                     {{"on", "string", false, "\"robot.hand\"", "",
                       "force_torque: the link of the robot that it sits on", "\"robot.hand\""},
                      {"rate", "integer", false, "120", "Hz", "divides the physics rate"}},
                     "string"};

const Record kLight{"light",
                    "One lamp far away (Lambert) and light from everywhere",
                    {{"direction", "vector", false, "{ -0.35, 0.3, -1 }", "", "in which the lamp shines"},
                     {"colour", "colour", false, "{ 1, 1, 1 }", "", "of both"},
                     {"ambient", "number", false, "0.5", "", "share of full brightness from everywhere"},
                     {"diffuse", "number", false, "0.6", "", "share of full brightness where the lamp shines straight"},
                     {"specular", "number", false, "0.15", "", "share of full brightness in highlights"}}};

const Record kMotion{
    "motion",
    "How arms find their way; --motion-planner goes before it",
    {{"planner", "string", false, "our own", "", "a geometric planner of OMPL by its name", "\"ompl:RRTConnect\""}}};

const Record kRandomise{
    "randomise",
    "Domain randomisation: drawn for each episode from its seed, and stored with it",
    {{"looks", "string[]", false, "{}", "",
      "whose looks: objects, their files, \"robot\", or \"*\" (all without a named "
      "colour)",
      "{ \"work_table\" }"},
     {"colours", "colour[]", false, "any", "", "that are drawn from", "colours.names"},
     {"textures", "cover[]", false, "plain", "", "that are drawn from: checker stripes noise plain, or texture { … }",
      "{ \"plain\", \"noise\", texture { \"wood.png\" } }"},
     {"ambient", "range", false, "{ 0.5, 0.5 }", "", "of the light"},
     {"diffuse", "range", false, "{ 0.6, 0.6 }", "", "of the light"},
     {"light_direction", "number", false, "0", "rad", "greatest tilt of the light"},
     {"camera_position", "number", false, "0", "m", "greatest shift of each camera"},
     {"camera_rotation", "number", false, "0", "rad", "greatest turn of each camera"},
     {"dynamics", "string[]", false, "{}", "", "whose dynamics, named as in looks; \"*\": all free bodies"},
     {"mass", "range", false, "{ 1, 1 }", "", "factors", "{ 0.8, 1.2 }"},
     {"friction", "range", false, "{ 1, 1 }", "", "factors"},
     {"damping", "range", false, "{ 1, 1 }", "", "factors"}}};

const Record kObserve{
    "observe",
    "What episodes record beside the low-dimensional frames; what is left out is not computed",
    {{"images", "string", false, "\"none\"", "", "of which frames: none, keyframes or all", "\"keyframes\""},
     {"cameras", "string[]", false, "all", "", "by name", "{ \"front\", \"wrist\" }"},
     {"size", "size", false, "each camera's own", "pixels", "of all pictures, 1 to 4096"},
     {"kinds", "string[]", false, "all", "", "rgb depth instance semantic", "{ \"rgb\", \"depth\" }"},
     {"points", "boolean", false, "false", "", "point clouds too"},
     {"shadows", "boolean", false, "false", "", "of the lamp"},
     {"noise", "observe_noise", false, "{}", "", "of cameras and joint torques"},
     {"channels", "string[]", false, "{ \"*\" }", "",
      "sensors of the world by name, \"*\" for all; and \"margins\": by how much each fact holds or fails to",
      "{ \"wrench\" }"}}};

const Record kObserveNoise{"observe_noise",
                           "What real sensors add (standard deviations)",
                           {{"rgb", "number", false, "0", "", "of each channel, of 0 … 1", "0.02"},
                            {"depth", "number", false, "0", "1/m", "times z squared; a Kinect's is 0.00145"},
                            {"torque", "number", false, "0", "N m", "of joint_torque"}}};

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
     {"allowed", "string[][]", false, "{}", "",
      "pairs of links that may touch; pairs are found by looking at the arm all over its range"},
     {"checked", "string[][]", false, "", "",
      "pairs of links that are tested for collision beside those that are found"},
     {"opening", "number", false, "0.08", "m", "both fingers together"},
     {"grip_force", "number", false, "20", "N", "of the fingers"},
     {"finger_speed", "number", false, "0.1", "m/s", "of each finger"},
     {"hand", "string", false, "\"hand\"", "", "name of its hand: ROBOT.hand"},
     {"pad_friction", "number", false, "", "", "Coulomb coefficient of the pads"},
     {"colours", "table", false, "{}", "", "colours by link"}}};

}  // namespace

const std::vector<Record>& records() {
  static const std::vector<Record> kRecords = {
      kTask,           kProblem, kSkill,  kPredicate, kObject, kWorld,   kRobot,     kEntry,   kPlace,
      kDeclaredNumber, kCase,    kPart,   kJoint,     kLatch,  kFollows, kRegion,    kTip,     kGrasp,
      kShape,          kTexture, kCamera, kSensor,    kLight,  kMotion,  kRandomise, kObserve, kObserveNoise};
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
