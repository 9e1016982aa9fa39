---@meta
-- The words of the authoring language and the methods of w, robot, rng and poses, for editors (LuaLS). stampede.lua has
-- the fields of each kind of file, names.lua the predicates, skills, types … that there are.

-- What has no other fields than its own
---@class stampede.closed: { [string]: never }
---@class stampede.draw
---@class stampede.on_table
---@class stampede.formula
---@class stampede.effect
---@class stampede.literal: stampede.formula, stampede.effect
---@class stampede.call

-- Facts: is.on("cup", "table"). names.lua has the predicates
---@class stampede.is
---@field pairwise fun(predicate: stampede.predicate_name, ...: string): stampede.formula  of each two: is.pairwise("apart", "cup*")
is = {}

-- Negated: is_not.on("cup", "table"), or is_not(any_of(…))
---@class stampede.is_not
---@field pairwise fun(predicate: stampede.predicate_name, ...: string): stampede.formula  of no two
---@overload fun(part: stampede.formula): stampede.formula
is_not = {}

-- Skills with their arguments: act.pick("cup"). names.lua has the skills
---@class stampede.act
act = {}

---@param ... stampede.formula|stampede.formula[]
---@return stampede.formula
function all_of(...) end

---@param ... stampede.formula|stampede.formula[]
---@return stampede.formula
function any_of(...) end

-- A whole goal: a part is met when all of it holds, parts have to be met in this order, and at the end all of them hold
---@param ... stampede.formula|stampede.formula[]
---@return stampede.formula
function in_order(...) end

-- n distinct members of the group such that f(b, i) holds for i = 1 … n; literals that name b[0] are left out
---@param group string  such as "block*"
---@param n integer
---@param f fun(b: string[], i: integer): stampede.formula
---@return stampede.formula
function any_order(group, n, f) end

-- forall("?x: block", is.on("?x", "table")): variables, then a formula (in effects: an effect) or a function of the variables
---@param ... string|stampede.formula|stampede.effect|fun(...: string): stampede.formula
---@return stampede.literal
function forall(...) end

-- exists("?x: block", is.on("?x", "table")): variables, then a formula or a function of the variables
---@param ... string|stampede.formula|fun(...: string): stampede.formula
---@return stampede.formula
function exists(...) end

-- In a goal: what init says of these things and their parts stays so; stays("others"): of all that the goal does not name
---@param ... string
---@return stampede.formula
function stays(...) end

-- n members of the group or more, whichever: at_least(4, "bean*", function(x) return is.inside(x, "bowl.space") end)
---@param n integer
---@param group string  such as "bean*"
---@param f fun(x: string): stampede.formula
---@return stampede.formula
function at_least(n, group, f) end

---@param a string
---@param b string
---@return stampede.formula
function equal(a, b) end

-- A formula as PDDL writes it
---@param text string
---@return stampede.formula
function pddl(text) end

-- A conditional effect
---@param condition stampede.formula
---@param effects stampede.effect|stampede.effect[]
---@return stampede.effect
function when(condition, effects) end

-- Candidates of a continuous parameter: stream("grasps"), stream("grasps", "part") or stream(is.on("obj", "to"));
-- stream("grasps", "part", "pull"): with which the arm can take the part to the joint position of its number `pull`
---@param source "grasps"|stampede.literal
---@param object? string  the parameter that is grasped
---@param to? string  a number of the part
function stream(source, object, to) end

-- A skill's whole run: run = policy("grasp_net", { seconds = 5 })
---@param name string
---@param options? stampede.policy_options
---@return fun(robot: any, p: any, c: any)
function policy(name, options) end

-- at = on_table { x, y } or on_table { x, y, above }, m: on the top of the world's table, or above it
---@param place number[]
---@return stampede.on_table
function on_table(place) end

-- One of the values, drawn per episode
---@return any
function one_of(...) end

-- n of the values, drawn per episode
---@param values any[]
---@param n integer
---@return any
function sample_of(values, n) end

-- A number, drawn per episode
---@param low number
---@param high number
---@return any
function between(low, high) end

-- Degrees in radians
---@param degrees number
---@return number
function deg(degrees) end

-- Millimetres in metres
---@param x number
---@return number
function mm(x) end

-- Centimetres in metres
---@param x number
---@return number
function cm(x) end

-- { f(value, index), … }
---@param list any[]
---@param f fun(value: any, index: integer): any
---@return any[]
function each(list, f) end

-- { first, …, last }
---@param first number
---@param last number
---@param step? number
---@return number[]
function range(first, last, step) end

-- The colours of worlds/colours.lua, by name
---@class stampede.colours
---@field names string[]  in alphabetical order
---@field apart fun(n: integer, count?: integer): string[][]  lists of n that nobody takes for one another: of such length
---@field except fun(...: string|string[]): string[]  all others that nobody takes for one of these: at least 32 apart
---@field difference fun(first: string, second: string): number  how different they look: CIEDE2000, 0 … 100
---@field rgb fun(name: string): number[]  sRGB, 0 … 1
colours = {}

-- A position [m] and an orientation. `p * q`: q in the frame p
---@class stampede.pose
---@operator mul(stampede.pose): stampede.pose
local stampede_pose = {}

-- pose(x, y, z, roll, pitch, yaw) or pose { at = …, rpy = …, yaw = …, quaternion = … } [m, rad]
---@param x number|table
---@param y? number
---@param z? number
---@param roll? number
---@param pitch? number
---@param yaw? number
---@return stampede.pose
function pose(x, y, z, roll, pitch, yaw) end

---@return number x, number y, number z
function stampede_pose:position() end
---@return number roll, number pitch, number yaw # about fixed axes [rad]
function stampede_pose:rpy() end
---@return number x, number y, number z, number w
function stampede_pose:quaternion() end
-- Moved along the world's axes
---@param x number
---@param y? number
---@param z? number
---@return stampede.pose
function stampede_pose:offset(x, y, z) end
-- Moved along its own axes
---@param x number
---@param y? number
---@param z? number
---@return stampede.pose
function stampede_pose:along(x, y, z) end
-- Turned about its own axes
---@param roll number
---@param pitch? number
---@param yaw? number
---@return stampede.pose
function stampede_pose:rotated(roll, pitch, yaw) end
-- Turned on the spot about the world's vertical
---@param yaw number
---@return stampede.pose
function stampede_pose:turned(yaw) end
---@param other stampede.pose
---@return stampede.pose
function stampede_pose:times(other) end
---@return stampede.pose
function stampede_pose:inverse() end
---@param x number
---@param y? number
---@param z? number
---@return stampede.pose
function stampede_pose:with_position(x, y, z) end

-- Seeded random draws
---@class stampede.random
local stampede_random = {}
---@return number # 0 … 1
function stampede_random:uniform() end
---@param low number
---@param high number
---@return number
function stampede_random:between(low, high) end
---@param low integer
---@param high integer
---@return integer # both ends included
function stampede_random:integer(low, high) end
---@return number # of mean 0 and deviation 1
function stampede_random:normal() end
---@generic T
---@param list T[]
---@return T
function stampede_random:pick(list) end

-- The world, as tests, predicates and skills read it; things are named by text [m, rad, s, N]
---@class stampede.world_view
local stampede_world_view = {}

-- Of a body, part, region's centre, or the hand's tip
---@param thing string
---@return number x, number y, number z
function stampede_world_view:position(thing) end
---@param thing string
---@return stampede.pose
function stampede_world_view:pose(thing) end
---@param thing string
---@return number x, number y, number z
function stampede_world_view:velocity(thing) end
---@param thing string
---@return number
function stampede_world_view:speed(thing) end
-- Edge lengths of its box
---@param thing string
---@return number x, number y, number z
function stampede_world_view:size(thing) end
-- Height of its lowest point
---@param thing string
---@return number
function stampede_world_view:bottom(thing) end
-- Height of its highest point
---@param thing string
---@return number
function stampede_world_view:top(thing) end
-- How far it reaches below its own frame when it is upright [m]
---@param thing string
---@return number
function stampede_world_view:below(thing) end
---@param a string
---@param b string
---@return number
function stampede_world_view:distance(a, b) end
---@param part string
---@return number
function stampede_world_view:joint(part) end
-- 0 at the lower limit, 1 at the upper
---@param part string
---@return number
function stampede_world_view:joint_fraction(part) end
---@param part string
---@return number
function stampede_world_view:joint_velocity(part) end
---@param part string
---@return number lower, number upper
function stampede_world_view:joint_range(part) end
-- Of a part whose joint lets go of it at a limit: has it not done so?
---@param part string
---@return boolean
function stampede_world_view:joined(part) end
-- Where the part would be if its joint were there
---@param part string
---@param position number
---@return stampede.pose
function stampede_world_view:part_at(part, position) end
---@param a string
---@param b string
---@return boolean
function stampede_world_view:touching(a, b) end
-- Between the two, over the last step
---@param a string
---@param b string
---@return number
function stampede_world_view:force(a, b) end
-- Does the surface bear it from below: a quarter of its weight at least; of what is held too, any touch from below? And
-- by how much: from its middle to the surface's edge; while it does not, minus the way to the surface's top (m)
---@param surface string
---@param thing string
---@return boolean supports
---@return number margin
function stampede_world_view:supports(surface, thing) end
---@param thing string
---@return boolean
function stampede_world_view:at_rest(thing) end
-- Between the pads of the hand? And how deep the tip is in its box; while it is not, minus the way there (m)
---@param thing string
---@return boolean grasped
---@return number margin
function stampede_world_view:grasped(thing) end
-- Grasped, and touched by nothing but the hand? And how deep it could fall; while it is not grasped, as grasped() (m)
---@param thing string
---@return boolean carried
---@return number margin
function stampede_world_view:carried(thing) end
-- Could the arm, from where it is, take it with two of its grasps at least, nothing in the way, however they are drawn;
-- with `before`, a part that it is behind, open?
---@param thing string
---@param before? string
---@return boolean
function stampede_world_view:can_grasp(thing, before) end
-- Could the arm, from where it is, take the part with two of its grasps at least and go with it towards its number `to`,
-- nothing in the way, with one grip after another at least as far as its number `enough` (by default `to`); with `before`,
-- a part that it is behind, open?
---@param part string
---@param to string
---@param before? string
---@param enough? string
---@return boolean
function stampede_world_view:can_move(part, to, before, enough) end
---@return string|nil
function stampede_world_view:grasped_object() end
-- Of the hand
---@return number
function stampede_world_view:opening() end
-- Its centre in the region; `whole`: all of it
---@param region string
---@param thing string
---@param whole? boolean
---@return boolean
function stampede_world_view:inside(region, thing, whole) end
-- From the nearest face of a region, or of the bounding box of another thing, to a thing, pose or point: negative inside
---@param region string
---@param x string|stampede.pose|number
---@param y? number
---@param z? number
---@return number
function stampede_world_view:region_distance(region, x, y, z) end
-- A number of its file (`numbers`), of those that traits and `reads` declare; of a thing without it the declared default,
-- or nil of an optional one
---@param thing string
---@param name stampede.number_name
---@return number
function stampede_world_view:number(thing, name) end
---@param thing string
---@param name string
---@return string|nil
function stampede_world_view:attribute(thing, name) end
---@param thing string
---@return string
function stampede_world_view:type(thing) end
---@param thing string
---@param trait string
---@return boolean
function stampede_world_view:has_trait(thing, trait) end
---@param thing string
---@return boolean
function stampede_world_view:exists(thing) end
-- Names in order: all, or those with the trait
---@param trait? string
---@return string[]
function stampede_world_view:objects(trait) end
---@return string
function stampede_world_view:hand() end
-- Where the robot stands: x ahead of it, y to its left
---@return stampede.pose
function stampede_world_view:base() end
-- The tool centre point
---@return stampede.pose
function stampede_world_view:tip() end
-- Since the episode began
---@return number
function stampede_world_view:time() end
-- Does it hold now (debounced, as verdicts and catalogues have it)? Not in predicates
---@param predicate stampede.predicate_name
---@param ... string
---@return boolean
function stampede_world_view:fact(predicate, ...) end
-- Is it known to hold: what can be hidden as it was when it was last seen. Not in predicates
---@param predicate stampede.predicate_name
---@param ... string
---@return boolean
function stampede_world_view:observed(predicate, ...) end
-- All facts, or those of one predicate: { { "on", "cup", "table" }, … }. Not in predicates
---@param predicate? stampede.predicate_name
---@return string[][]
function stampede_world_view:facts(predicate) end
-- In `sample`: poses of the thing where it would rest on the surface, free of others; with `centre`, those alone whose
-- frame is at most x and y (m) from it along its axes
---@param surface string
---@param thing string
---@param rng stampede.random
---@param centre? stampede.pose
---@param x? number
---@param y? number
---@return stampede.pose[]
function stampede_world_view:free_spots(surface, thing, rng, centre, x, y) end
-- In `sample`: poses of the thing on top of another
---@param below string
---@param thing string
---@param rng stampede.random
---@return stampede.pose[]
function stampede_world_view:stack_spots(below, thing, rng) end
-- In `sample`: poses of the thing within the region; `floating`: of a region
---@param region string
---@param thing string
---@param rng stampede.random
---@param floating? boolean
---@return stampede.pose[]
function stampede_world_view:region_spots(region, thing, rng, floating) end
-- In `sample`: the part's joint at a position
---@param part string
---@param position number
function stampede_world_view:joint_at(part, position) end
-- In `sample`: the part's joint anywhere between two positions
---@param part string
---@param low number
---@param high number
---@param rng stampede.random
function stampede_world_view:joint_between(part, low, high, rng) end
-- In `sample`: another thing than the literal's first argument at a pose
---@param thing string
---@param at stampede.pose
function stampede_world_view:place(thing, at) end

---@class stampede.policy_options
---@field seconds? number  at most, 10
---@field until_effect? boolean  true: it ends when the skill's effect holds
---@field with? table<string, number|number[]>  what the policy is told beside the skill's parameters

---@class stampede.line_options
---@field speed? number  [m/s]
---@field force? number  ends the motion [N]
---@field stop_on_contact? boolean
---@field tolerate? boolean  an end that is not reached is no failure
---@field keep_clear? boolean  refused where arm or load would touch anything but the skill's own objects
---@field most_force? number  the arm gives way to contact and ends the motion where it meets more [N]
---@field press? number  presses with this force while it moves [N]
---@field press_along? number[]  in which direction of the world (default the tool's z)
---@field search? number  where it is blocked it looks around, at most so far from the line, for a way on [m]
---@field pitch? number  of the spiral on which it looks (default 0.8 mm) [m]
---@field open? number  the hand begins to open or close to this as the line begins [m]
---@field as_far_as_it_goes? boolean  half of it will do where the arm cannot follow to the end

-- One of to, by, arc and tilt; none of them where the hand alone moves
---@class stampede.piece
---@field to? stampede.pose  straight to a pose
---@field by? number[]  straight by an offset along the world's axes, from where the piece begins [m]
---@field arc? number  around a line of the world: `axis` through `about`, or the axis of the joint of the part `about` [rad]
---@field tilt? number  about `axis` of the tool's own frame (default its z) through `about` (default the tip) [rad]
---@field axis? number[]
---@field about? stampede.pose|number[]|string  a tilt: three numbers are of the tool's frame; what is held moves along
---@field turn? boolean  of an arc, false: the tool keeps its orientation
---@field speed? number  of the tip [m/s]
---@field turn_speed? number  of the tool [rad/s]
---@field stop? boolean  rests at its end
---@field name? string  stored as a via with the moment at which it ends
---@field open? number  the hand begins to open or close to this as the piece begins [m]

---@class stampede.follow_options
---@field speed? number  of pieces that say none (default 0.25) [m/s]
---@field turn_speed? number  of pieces that say none (default 1) [rad/s]
---@field blend? number  corners are cut within this distance (default 0.01) [m]
---@field most_force? number  the arm gives way to contact and ends the motion where it meets more [N]
---@field press? number  presses with this force while it moves [N]
---@field press_along? number[]  in which direction of the world (default the tool's z)
---@field keep_clear? boolean  refused where arm or load would touch anything but the skill's own objects
---@field tolerate? boolean  an end that is not reached is no failure

---@class stampede.tilt_options: stampede.follow_options
---@field axis? number[]
---@field about? stampede.pose|number[]|string
---@field name? string
---@field open? number

---@class stampede.found_grasp
---@field pose stampede.pose
---@field approach stampede.pose
---@field on_object stampede.pose
---@field width number
---@field opening number
---@field force number
---@field reach? number  the position to which the arm can take the part's joint from here

-- The arm and its hand, in a skill's `run`
---@class stampede.robot_view
local stampede_robot_view = {}
---@param opening? number  [m] (default as far as it goes)
function stampede_robot_view:open_hand(opening) end
-- With an object, it must end up held
---@param object? string
---@param options? { force: number? }
function stampede_robot_view:close_hand(object, options) end
-- { approach = pose, grasp = pose }: approach first, then others by name, last grasp, goal, place or target. Or
-- { { "name", pose }, … } in the order written. All but the last are passed without a stop.
-- `ahead`: poses after the last to which the arm must be able to go on. `then_part`: a part that it must be able to take
-- from there to joint position `to`, see move_part, with the hand as wide as `opening`
-- [m], and to go straight back from there by `retreat` [m]. `then_follow`: or pieces that it must be able to travel from
-- there, see follow, with nothing touched but the skill's own objects. `tool`: a tool in the hand whose tip the poses are of
---@param targets table<string, stampede.pose>|any[][]
---@param options? { then_part: string?, to: number?, pivot: number?, opening: number?, retreat: number?, then_follow: stampede.piece[]?, tool: string? }
function stampede_robot_view:move_through(targets, options) end
---@param target stampede.pose
---@param options? { tool: string }
function stampede_robot_view:move_to(target, options) end
-- Straight, to a pose or by an offset along the world's axes. `tool`: a tool in the hand whose tip the pose is of
---@param target stampede.pose|number[]
---@param options? stampede.line_options|{ tool: string }
function stampede_robot_view:move_line(target, options) end
-- A registered policy acts, frame by frame, until it is done, the skill's effect holds, or time is up
---@param name string
---@param options? stampede.policy_options
function stampede_robot_view:policy(name, options) end
-- Straight up
---@param height number
---@param options? stampede.line_options
function stampede_robot_view:lift(height, options) end
-- Straight back, out of the hand's direction
---@param distance number
---@param options? stampede.line_options
function stampede_robot_view:retreat(distance, options) end
function stampede_robot_view:move_home() end
---@param positions number[]
function stampede_robot_view:move_joints(positions) end
-- The held handle along its joint. `pivot`: so far, in rad either way, the handle may turn in the hand about the joint's
-- axis; within that the hand turns as the arm can best follow
-- and can then go straight back by `retreat` [m]. `as_far_as_it_goes`: where the arm cannot follow the whole way, as much
-- of it as it can; w:joint(part) then says how far that was. `then_to`: the position to which another move_part takes it
-- on: the arm goes so that it can follow until there, if it can
---@param part string
---@param position number
---@param options? { speed: number?, most_force: number?, pivot: number?, retreat: number?, as_far_as_it_goes: boolean?, then_to: number? }
function stampede_robot_view:move_part(part, position, options) end
-- The joint position nearest to `to` that the arm can take the held part to from here
---@param part string
---@param to number
---@param options? { pivot: number?, retreat: number? }
---@return number
function stampede_robot_view:reach_of_part(part, to, options) end
-- A grasp of the part, where it is now, from which the arm can take it to `to`, or as far as any: its `reach`
---@param part string
---@param to number
---@param options? { pivot: number?, retreat: number? }
---@return stampede.found_grasp|nil
function stampede_robot_view:find_grasp(part, to, options) end
-- Pieces one after the other, in one motion that stops where a piece says so and at the end
---@param pieces stampede.piece[]
---@param options? stampede.follow_options
function stampede_robot_view:follow(pieces, options) end
-- Turns the tool about an axis of its own: pours, screws
---@param angle number  [rad]
---@param options? stampede.tilt_options
function stampede_robot_view:tilt(angle, options) end
---@param seconds number
function stampede_robot_view:wait(seconds) end
-- Another skill as a part of this one, with all its arguments but the hand
---@param call stampede.call
function stampede_robot_view:run(call) end
-- Gives up: a reason of the list in engine/include/stampede/reason.h, or any text
---@param reason string
---@param detail? string
function stampede_robot_view:fail(reason, detail) end
-- The tool centre point
---@return stampede.pose
function stampede_robot_view:tip() end
-- Where the tip must be for the held object to be at a pose
---@param object string
---@param at stampede.pose
---@return stampede.pose
function stampede_robot_view:tip_for(object, at) end
---@return stampede.world_view
function stampede_robot_view:view() end
