---@meta
-- Made by `stampede doc` from the field tables of scripting/library/fields.cpp: do not edit.

-- What is to be done: objects, how they start, what must be true at the end
---@class stampede.task: stampede.closed
---@field world? stampede.world_name|string  the world file it takes place in (default "tabletop")
---@field variations? table|table[]  axes (their product) or an explicit list of variations (default {})
---@field where? (fun(v: table<string, any>): any, any?)  function(v): false leaves a combination of the axes out
---@field objects? table<string, stampede.entry>|fun(v: table<string, any>): any  the objects by name; count = n makes name1 … namen (default {})
---@field init? stampede.formula[]|stampede.formula|fun(v: table<string, any>): any  what holds at the start, in the order in which it is made true; formulas such as exists are met by drawing (default {})
---@field told? stampede.formula[]|stampede.formula|fun(v: table<string, any>): any  facts of the start that the sentences tell, where nobody can see them: plans need not search (default {})
---@field goal stampede.formula|stampede.formula[]|fun(v: table<string, any>): any  what must hold at the end
---@field observable? table  by predicate, what of its facts can be seen here, beside what its file says: function(w, …), or false: nothing (default {})
---@field hand? string  at the end: empty, or any; what the goal says of the hand or of things held goes before it (default empty)
---@field skills? string[]  skills that extend or replace others, for this task (default {})
---@field steps? stampede.call[]|stampede.call|fun(v: table<string, any>): any  the skills to execute, instead of a plan
---@field also? (fun(w: stampede.world_view, v: table<string, any>): any, any?)  function(w, v): a further test beside the goal
---@field fails? (fun(w: stampede.world_view, v: table<string, any>): any, any?)  function(w, v): true ends the episode as failed, for the reason failed_by_task
---@field reward? (fun(w: stampede.world_view, v: table<string, any>): any, any?)  function(w, v): a shaped reward, added to 1 at success
---@field subgoals? table|fun(v: table<string, any>): any  formulas by name, or a list in order of { "name", formula } or { "name", formula, "sentence" }; {axis} in it is the variation's value (default {})
---@field horizon? number|fun(v: table<string, any>): any  the longest an episode may take [s] (default 120)
---@field observe? stampede.observe  pictures and sensors to record; goes before the world's, field by field (default {})
---@field hold? number|fun(v: table<string, any>): any  for how long the goal must stay true at the end [s] (default 1.0)
---@field instructions string[]|string|fun(v: table<string, any>): any  sentences; {axis} is the variation's value
---@field problem? stampede.problem  what `stampede import` made it from: its episodes are judged by it too

-- The problem of another language that a task was imported from
---@class stampede.problem
---@field dialect string  whose words it is in: libero or behavior
---@field text string  the whole problem, as that language writes it
---@field mapping? string  a file of worlds/bddl by name: our words for its words (default the dialect's)
---@field names? table  its names, and ours where a thing has another one here (default {})

-- A parameterised action: when it may be done, what it brings about, and how
---@class stampede.skill
---@field params? string[]  "name: type & trait"; the hand is appended by itself
---@field precondition? stampede.formula[]|stampede.formula  what must hold before (default {})
---@field effect? stampede.effect[]|stampede.effect  what holds afterwards; tested after each run (default {})
---@field cases? table<string, stampede.case>  instead of precondition and effect: several operators that share run
---@field continuous? table  continuous parameters by name: a number or vector with min max unit, or a stream (default {})
---@field controller? string  joint_position, joint_impedance or cartesian_impedance (default "joint_position")
---@field stiffness? number  of an impedance controller; 0: its default [N/m or N m/rad] (default 0)
---@field label? string  what it does in words, with {params}
---@field verbs? string[]  that tell of it in sentences, the first its own (default its label's)
---@field reads? table<string, stampede.declared_number>  numbers of its things that it reads, beside those of their traits (default {})
---@field run? (fun(robot: stampede.robot_view, p: table<string, any>, c: table<string, any>): any, any?)  function(robot, p, c): p parameters, c continuous parameters
---@field forgets? string[]  predicates that contact leaves uncertain (default {})
---@field cost? integer  of the action in a plan (default 1)
---@field moves? string[]  parameters that it moves: what ends_when "moved" of them ends (default {})
---@field extends? string  a skill whose fields it has where it gives none itself; conditions and effects add up. It takes that one's place in tasks and worlds that name it in their skills
---@field replaces? string  a skill whose place it takes in tasks and worlds that name it in their skills
---@field may_equal? string[][]  pairs of parameters that may be one object (default {})

-- A typed symbol with a test on the state of the world
---@class stampede.predicate
---@field params? string[]  "name: type & trait"; one of type hand may be left out in literals
---@field label? string  the fact in words, with {params}
---@field holds? (fun(w: stampede.world_view, ...: any): any, any?)  function(w, …): does it hold, and a signed margin if there is one: not negative exactly while it holds
---@field derived? stampede.formula  the formula that it stands for, instead of holds
---@field reads? table<string, stampede.declared_number>  numbers of its things that it reads, beside those of their traits (default {})
---@field sample? (fun(w: stampede.world_view, ...: any): any, any?)  function(w, …, rng): poses or joint positions that make it true
---@field static? boolean  cannot change in an episode: read once, at the start (default false)
---@field start_only? boolean  a condition for init and --where, tested when a start is drawn; never a fact, so no goal or skill names it (default false)
---@field extends? string  a predicate whose fields it has where it gives none itself; it holds where that one holds and its own test too
---@field settle? number  a shorter change is noise [s] (default 0)
---@field momentary? boolean  read at every physics step, without settle time (default false)
---@field remember? boolean  stays true once true (default false)
---@field ends_when? string  "moved": it ends when a skill moves one of its things, also one that knows nothing of it
---@field only_named? boolean  followed, and so a fact, in those tasks alone that name it: in a formula, or in a function as a text (default false)
---@field made_by? string[]  skills that make it true by where they put its first thing, when the goal asks for it; what moves one of its things ends it (default {})
---@field requires? string  what can hold at all: pairs that are "touching" or "near"; "held": the last is in the hand (default "all")
---@field mutex? string[]  predicates that cannot hold of the same first argument: no start is drawn with both (default {})
---@field functional? boolean|string  at most one value of the last (or named) parameter: no start is drawn with two (default false)
---@field observable? (fun(w: stampede.world_view, ...: any): any, any?)|boolean  function(w, …): can one see now whether it holds; false: never (default true)
---@field margin_unit? string  unit of the margin; channel `margins` is of the predicates that say one; "m or rad": the joint's

-- A thing: shape, mass, type, traits, parts, grasps
---@class stampede.object
---@field type? stampede.type_name|string  its class in the type tree of worlds/types.lua
---@field nouns? string  what else it is called in sentences, beside its own name and its types' (default "")
---@field traits? (stampede.trait_name|string)[]  what can be done with it (default {})
---@field shape? stampede.shape  its one shape
---@field shapes? stampede.shape[]  its shapes, convex each (default {})
---@field visual? stampede.shape|stampede.shape[]  what is drawn instead of shapes, which then only collide
---@field mass? number  of the whole body or part [kg] (default 0)
---@field friction? number  Coulomb coefficient; a pair's is the product of both (default 0.5)
---@field rolling? number  rolling friction [m] (default 0.001)
---@field spinning? number  friction about the contact normal [m] (default 0.001)
---@field restitution? number  bounce, 0 … 1 (default 0)
---@field colour? string|number[]  of every shape that has none; a name is an attribute too
---@field texture? stampede.texture  of every shape that has neither colour nor texture; colour tints it
---@field attributes? table  static facts: texts by name (default {})
---@field numbers? stampede.numbers  numbers by name for predicates: w:number(obj, "open_at") (default {})
---@field regions? table<string, stampede.region>  named boxes fixed to it, without mass (default {})
---@field grasps? stampede.grasp[]  where a hand may take it; none: from its geometry (default {})
---@field size? number[]|number[]|number  edge lengths where a file builds its shape from them [m]
---@field scale? number|number[]  of its meshes (default 1)
---@field fixed? boolean  stands still (furniture) (default not movable)
---@field place? stampede.place  at and a turn together, where one draw chooses both; an entry's at goes before it
---@field region? stampede.region  the whole object is a region: no mass, no contact
---@field parts? table<string, stampede.part>  articulated parts, addressed object.part (default {})
---@field urdf? string  a URDF file beside this one, instead of shapes
---@field tip? stampede.tip  where a tool acts: the region OBJECT.tip, `{ tool = "OBJECT" }` of moves
---@field declares? table  types, traits and numbers of its own, as worlds/types.lua does: { types = {…}, traits = {…}, numbers = {…} } (default {})

-- Where tasks take place: robot, fixtures, cameras, sensors, light
---@class stampede.world: stampede.closed
---@field robot stampede.entry  the robot file and where it stands
---@field skills? string[]  skills that extend or replace others, for its tasks (default {})
---@field fixtures? table<string, stampede.entry>  objects that every task has (default {})
---@field cameras? table<string, stampede.camera>  by name (default {})
---@field calibration? string  a file beside this one with cameras as they were measured; they replace those of the same names
---@field sensors? table<string, stampede.sensor>  by name (default {})
---@field light? stampede.light  one lamp far away and light from everywhere (default {})
---@field randomise? stampede.randomise  what --randomise draws for each episode
---@field observe? stampede.observe  pictures and sensors that its episodes record (default {})
---@field motion? stampede.motion  how its arms find their way (default {})
---@field regions? table<string, stampede.region>  fixed to the world (default {})
---@field gravity? number[]   [m/s^2] (default { 0, 0, -9.81 })
---@field physics_hz? integer  physics and control [Hz] (default 240)
---@field frame_hz? integer  recorded frames; divides physics_hz [Hz] (default 20)

-- What a URDF cannot say about an arm
---@class stampede.robot: stampede.closed
---@field urdf string  the URDF file beside this one
---@field arm string[]  its driven joints from base to tip
---@field tip table  the tool centre point: link, at, rpy [m, rad]
---@field home number[]  where every episode starts [rad]
---@field fingers? string[]  two sliding joints, coupled (default {})
---@field pads? string[]  the links whose contact counts as touch (default {})
---@field limits? table  numbers or one per joint: velocity, acceleration, jerk, effort [rad/s …] (default {})
---@field velocity? number[]  limits, one per joint; more than the URDF says is cut [rad/s]
---@field acceleration? number[]  limits, one per joint [rad/s^2]
---@field jerk? number[]  limits, one per joint [rad/s^3]
---@field effort? number[]  limits, one per joint [N m]
---@field checked_pairs? string[][]  the same as checked
---@field allowed_pairs? string[][]  the same as allowed
---@field pad? table  surface of the pads: friction, rolling, spinning, anchor (default {})
---@field allowed? string[][]  pairs of links that may touch; pairs are found by looking at the arm all over its range (default {})
---@field checked? string[][]  pairs of links that are tested for collision beside those that are found
---@field opening? number  both fingers together [m] (default 0.08)
---@field grip_force? number  of the fingers [N] (default 20)
---@field finger_speed? number  of each finger [m/s] (default 0.1)
---@field hand? string  name of its hand: ROBOT.hand (default "hand")
---@field pad_friction? number  Coulomb coefficient of the pads
---@field colours? table  colours by link (default {})

-- One line of a task's objects or a world's fixtures: a class and what differs from its file
---@class stampede.entry: stampede.object
---@field [integer] stampede.object_name|string
---@field count? integer  makes a group name1 … namen (0: an empty one)
---@field at? number[]|stampede.on_table  fixed position of the body in the world [m]
---@field yaw? number  turn about the vertical [rad] (default 0)
---@field rpy? number[]  orientation about fixed axes, instead of yaw [rad] (default { 0, 0, 0 })
---@field quaternion? number[]  orientation x y z w, instead of yaw
---@field joints? table  initial joint positions by part; of a robot, where its arm starts instead of at home [rad or m] (default {})

-- Where something stands
---@class stampede.place
---@field at number[]|stampede.on_table  position of the body in the world [m]
---@field yaw? number  turn about the vertical [rad] (default 0)
---@field rpy? number[]  orientation about fixed axes, instead of yaw [rad] (default { 0, 0, 0 })
---@field quaternion? number[]  orientation x y z w, instead of yaw

-- A number that things can have, for w:number: what it says, its unit and what is read of things without it
---@class stampede.declared_number
---@field [integer] string
---@field of? string|string[]  the parameters whose things have it
---@field unit? string  m, rad, m or rad, s, kg, N, N m, or none: a count (default "")
---@field default? number  of things without it; none: they must have it [unit]
---@field optional? boolean  of things without it nil is read (default false)
---@field min? number  the least that makes sense [unit]
---@field max? number  the greatest [unit]

-- One operator of a skill with several
---@class stampede.case
---@field precondition? stampede.formula[]|stampede.formula  what must hold before (default {})
---@field effect stampede.effect[]|stampede.effect  what holds afterwards
---@field cost? integer  of this action in a plan (default 1)

-- A moving part of an object
---@class stampede.part
---@field type? stampede.type_name|string  its class in the type tree of worlds/types.lua
---@field nouns? string  what else it is called in sentences, beside its own name and its types' (default "")
---@field traits? (stampede.trait_name|string)[]  what can be done with it (default {})
---@field shape? stampede.shape  its one shape
---@field shapes? stampede.shape[]  its shapes, convex each (default {})
---@field visual? stampede.shape|stampede.shape[]  what is drawn instead of shapes, which then only collide
---@field mass? number  of the whole body or part [kg] (default 0)
---@field friction? number  Coulomb coefficient; a pair's is the product of both (default 0.5)
---@field rolling? number  rolling friction [m] (default 0.001)
---@field spinning? number  friction about the contact normal [m] (default 0.001)
---@field restitution? number  bounce, 0 … 1 (default 0)
---@field colour? string|number[]  of every shape that has none; a name is an attribute too
---@field texture? stampede.texture  of every shape that has neither colour nor texture; colour tints it
---@field attributes? table  static facts: texts by name (default {})
---@field numbers? stampede.numbers  numbers by name for predicates: w:number(obj, "open_at") (default {})
---@field regions? table<string, stampede.region>  named boxes fixed to it, without mass (default {})
---@field grasps? stampede.grasp[]  where a hand may take it; none: from its geometry (default {})
---@field size? number[]|number[]|number  edge lengths where a file builds its shape from them [m]
---@field scale? number|number[]  of its meshes (default 1)
---@field parent? string  the part that it hangs on (default the base)
---@field slider? stampede.joint  moves along an axis
---@field hinge? stampede.joint  turns about an axis
---@field screw? stampede.joint  turns about an axis and travels along it
---@field fixed? stampede.joint|boolean  does not move relative to its parent

-- How a part moves
---@class stampede.joint
---@field axis? number[]  in the joint's frame (default { 0, 0, 1 })
---@field at? number[]  origin in the parent's frame [m] (default { 0, 0, 0 })
---@field rpy? number[]  orientation in the parent's frame [rad] (default { 0, 0, 0 })
---@field yaw? number  instead of rpy [rad] (default 0)
---@field range? number[]  lower and upper limit [rad or m]
---@field initial? number  position at the start [rad or m] (default 0)
---@field damping? number  torque or force per speed [N m s or N s/m] (default 0)
---@field friction? number  greatest friction [N m or N] (default 0)
---@field spring? number  constant force back to spring_target [N m or N] (default 0)
---@field spring_target? number  where the spring pushes to [rad or m] (default 0)
---@field stiffness? number  force per way from spring_target, beside spring [N m/rad or N/m] (default 0)
---@field detent? number  holds at a limit until this is exceeded [N m or N] (default 0)
---@field pitch? number  of a screw: travel in a whole turn; negative: left-handed [m]
---@field lets_go? number  where the joint lets go of its part, for good; until then that is a thing of its own that is held there [rad or m]
---@field follows? stampede.follows  coupled to another joint; each moves the other
---@field latch? stampede.latch  locked until another joint is moved

-- A lock that another part opens
---@class stampede.latch
---@field key string  the part whose joint unlocks this one
---@field open number  the key's position that unlocks [rad or m]
---@field close? number  locks again below this position [rad or m] (default 0)

-- A coupling of two joints of an object: position = ratio * the other's + offset
---@class stampede.follows
---@field part string  the part whose joint this one follows
---@field ratio? number  of both positions, such as rad per m (default 1)
---@field offset? number  this position where the other is 0 [rad or m] (default 0)

-- A named box without mass or contact
---@class stampede.region
---@field at? number[]  its centre [m] (default { 0, 0, 0 })
---@field rpy? number[]  its orientation [rad] (default { 0, 0, 0 })
---@field yaw? number  instead of rpy [rad] (default 0)
---@field size number[]  full edge lengths [m]
---@field type? stampede.type_name|string  its class in the type tree (default "region")
---@field traits? (stampede.trait_name|string)[]  what can be done with it (default {})
---@field attributes? table  static facts (default {})
---@field numbers? stampede.numbers  numbers by name (default {})
---@field visible? boolean  drawn in pictures (default false)
---@field colour? string|number[]  when visible

-- The point of a tool that acts: z out of the tool, in the direction in which it works
---@class stampede.tip
---@field at? number[]  in the object's frame, on the tool or at most 5 mm off it [m] (default { 0, 0, 0 })
---@field rpy? number[]  in the object's frame [rad] (default { 0, 0, 0 })
---@field yaw? number  instead of rpy [rad] (default 0)
---@field quaternion? number[]  instead of rpy

-- Where a hand may take an object
---@class stampede.grasp
---@field at? number[]  tool centre point in the object's frame [m] (default { 0, 0, 0 })
---@field rpy? number[]  z out of the hand, y along the closing axis [rad] (default { 0, 0, 0 })
---@field yaw? number  instead of rpy [rad] (default 0)
---@field quaternion? number[]  instead of rpy
---@field width? number  opening at contact [m] (default 0.04)
---@field approach? number  way of the straight approach [m] (default 0.08)
---@field force? number  of the fingers [N] (default 20)

-- box { x, y, z }  sphere { r }  cylinder { r, length }  capsule { r, length }  cone { r, length }  hull { points }  lathe { { r, z }, … }  mesh { "file" }
---@class stampede.shape
---@field [integer] any
---@field tag string  set by the words
---@field shape string  set by the words
---@field line? integer  set by the words
---@field at? number[]  in the part's frame [m] (default { 0, 0, 0 })
---@field rpy? number[]  in the part's frame [rad] (default { 0, 0, 0 })
---@field yaw? number  instead of rpy [rad] (default 0)
---@field quaternion? number[]  instead of rpy
---@field colour? string|number[]  of this shape
---@field texture? stampede.texture  of this shape; its colour tints it
---@field collides? boolean  touches others (default true)
---@field visible? boolean  is drawn (default true)
---@field shows? stampede.formula  drawn only while this fact of the object ("self"), a part or a region of it holds, or does not
---@field scale? number|number[]  of a mesh file (default 1)
---@field segments? integer  wedges of a lathe (default 16)
---@field wall? number  of a hollow lathe, which collides as wedges [m]

-- texture { "file.png" }  checker { colour, colour }  stripes { colour, colour }  noise { colour, colour }
---@class stampede.texture
---@field [integer] any
---@field tag string  set by the words
---@field texture string  set by the words
---@field line? integer  set by the words
---@field size? number  of one repeat, along the axes of the shape [m] (default 0.1)
---@field seed? integer  of noise (default 0)

-- Where pictures are taken from. Its own frame: x right, y down, z forward
---@class stampede.camera
---@field at number[]  position, in the world or on its mount [m]
---@field look_at? string|number[]  an object of the world, or a point of the frame that `at` is in
---@field rpy? number[]  of its frame, instead of look_at [rad]
---@field quaternion? number[]  of its frame, x y z w, instead of look_at
---@field up? number[]  which way is up in the picture (default { 0, 0, 1 })
---@field mount? string  what it moves with: an object, or a link of the robot
---@field fov? number  vertical field of view [rad] (default deg(40))
---@field focal? number[]  focal lengths { fx, fy }, instead of fov [pixels]
---@field centre? number[]  where the optical axis meets the picture, { cx, cy } [pixels] (default half the size)
---@field distortion? number[]  of the lens (Brown): { k1, k2, p1, p2, k3 } (default { 0, 0, 0, 0, 0 })
---@field size? number[]  width and height, 1 to 4096 [pixels] (default { 128, 128 })
---@field near? number  nothing nearer is seen [m] (default 0.01)
---@field far? number  nothing farther is seen; pictures of depth end at 6.55 [m] (default 4.5)

-- Something measured beside the frames: "force_torque" or "joint_torque"
---@class stampede.sensor
---@field [integer] string
---@field on? string  force_torque: the link of the robot that it sits on (default "robot.hand")
---@field rate? integer  divides the physics rate [Hz] (default 120)

-- One lamp far away (Lambert) and light from everywhere
---@class stampede.light
---@field direction? number[]  in which the lamp shines (default { -0.35, 0.3, -1 })
---@field colour? string|number[]  of both (default { 1, 1, 1 })
---@field ambient? number  share of full brightness from everywhere (default 0.5)
---@field diffuse? number  share of full brightness where the lamp shines straight (default 0.6)
---@field specular? number  share of full brightness in highlights (default 0.15)

-- How arms find their way; --motion-planner goes before it
---@class stampede.motion
---@field planner? string  a geometric planner of OMPL by its name (default our own)

-- Domain randomisation: drawn for each episode from its seed, and stored with it
---@class stampede.randomise
---@field looks? string[]  whose looks: objects, their files, "robot", or "*" (all without a named colour) (default {})
---@field colours? string|number[][]  that are drawn from (default any)
---@field textures? string|stampede.texture[]  that are drawn from: checker stripes noise plain, or texture { … } (default plain)
---@field ambient? number[]  of the light (default { 0.5, 0.5 })
---@field diffuse? number[]  of the light (default { 0.6, 0.6 })
---@field light_direction? number  greatest tilt of the light [rad] (default 0)
---@field camera_position? number  greatest shift of each camera [m] (default 0)
---@field camera_rotation? number  greatest turn of each camera [rad] (default 0)
---@field dynamics? string[]  whose dynamics, named as in looks; "*": all free bodies (default {})
---@field mass? number[]  factors (default { 1, 1 })
---@field friction? number[]  factors (default { 1, 1 })
---@field damping? number[]  factors (default { 1, 1 })

-- What episodes record beside the low-dimensional frames; what is left out is not computed
---@class stampede.observe
---@field images? string  of which frames: none, keyframes or all (default "none")
---@field cameras? string[]  by name (default all)
---@field size? number[]  of all pictures, 1 to 4096 [pixels] (default each camera's own)
---@field kinds? string[]  rgb depth instance semantic (default all)
---@field points? boolean  point clouds too (default false)
---@field shadows? boolean  of the lamp (default false)
---@field noise? stampede.observe_noise  of cameras and joint torques (default {})
---@field channels? string[]  sensors of the world by name, "*" for all; and "margins": by how much each fact holds or fails to (default { "*" })

-- What real sensors add (standard deviations)
---@class stampede.observe_noise
---@field rgb? number  of each channel, of 0 … 1 (default 0)
---@field depth? number  times z squared; a Kinect's is 0.00145 [1/m] (default 0)
---@field torque? number  of joint_torque [N m] (default 0)

---@param fields stampede.task
---@return stampede.task
function task(fields) end

---@param fields stampede.skill
---@return stampede.skill
function skill(fields) end

---@param fields stampede.predicate
---@return stampede.predicate
function predicate(fields) end

---@param fields stampede.object
---@return stampede.object
function object(fields) end

---@param fields stampede.world
---@return stampede.world
function world(fields) end

---@param fields stampede.robot
---@return stampede.robot
function robot(fields) end

---@return stampede.shape
function box(fields) end

---@return stampede.shape
function sphere(fields) end

---@return stampede.shape
function cylinder(fields) end

---@return stampede.shape
function capsule(fields) end

---@return stampede.shape
function cone(fields) end

---@return stampede.shape
function hull(fields) end

---@return stampede.shape
function lathe(fields) end

---@return stampede.shape
function mesh(fields) end

---@return stampede.texture
function texture(fields) end

---@return stampede.texture
function checker(fields) end

---@return stampede.texture
function stripes(fields) end

---@return stampede.texture
function noise(fields) end
