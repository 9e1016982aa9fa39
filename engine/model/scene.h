// What one episode takes place in: bodies, their parts and joints, regions, cameras and the robot.
// Immutable once built. sim builds a world from it, render draws it, the catalogue stores it as one document.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/geometry/drawn_mesh.h"
#include "engine/geometry/transform.h"

namespace stampede {

struct Colour {
  double red = 0.7, green = 0.7, blue = 0.7, alpha = 1.0;  // 0 … 1, sRGB
};

enum class ShapeKind { box, sphere, cylinder, capsule, cone, hull, mesh };

// Convex, but for a mesh, which is drawn only: its `collides` is false. cylinder, capsule and cone stand along z,
// centred; a capsule's length leaves out its caps.
struct Shape {
  ShapeKind kind = ShapeKind::box;
  Vector3 size = Vector3::Zero();  // box: full edge lengths, m
  double radius = 0, length = 0;   // the round ones, m
  std::vector<Vector3> points;     // hull, in the shape's frame, m
  std::string mesh;                // mesh: a key of Scene::meshes
  Transform part_from_shape = Transform::Identity();
  Colour colour;
  std::string texture;  // a key of Scene::textures, its colours multiplied by `colour`; empty: plain
  bool collides = true;
  bool visible = true;
  std::vector<std::string> shown_by;  // a fact, predicate first: drawn only while it holds; empty: always drawn
  bool shown_without = false;         // … only while it does not hold
};

struct Surface {
  double friction = 0.5;    // Coulomb; a pair's is the product of both
  double rolling = 0.001;   // torsional about the tangent
  double spinning = 0.001;  // torsional about the normal
  double restitution = 0;
  bool anchor = false;  // Bullet's friction anchor: for finger pads
};

enum class JointKind { fixed, hinge, slider, screw };

// How a part moves relative to its parent. Units: rad, N m, N m s for hinges and screws; m, N, N s/m for sliders.
struct Joint {
  std::string name;
  JointKind kind = JointKind::fixed;
  Vector3 axis = Vector3::UnitZ();                      // in the joint's frame
  Transform parent_from_joint = Transform::Identity();  // the part's frame is the joint's frame, moved by q
  double pitch = 0;  // of a screw: travel along the axis in a whole turn, m; negative: left-handed
  double lower = 0, upper = 0;
  double initial = 0;       // position at the start of an episode
  double damping = 0;       // torque per speed
  double friction = 0;      // greatest friction torque
  double effort = 0;        // greatest motor torque (robots)
  double velocity = 0;      // greatest speed (robots), 0: none
  double spring_force = 0;  // constant return force towards spring_target (buttons); 0: none
  double spring_target = 0;
  double stiffness = 0;  // beside it, a force per way from spring_target, N/m or N m/rad (scales)
  double detent = 0;     // holds the joint at its lower or upper limit until this force is exceeded; 0: none
  // Latch: while locked, this joint is held at `lower`. It unlocks when joint `latch_key` passes `latch_open`
  // and locks again when this joint is back below latch_close and the key is back. Empty key: no latch.
  std::string latch_key;
  double latch_open = 0;
  double latch_close = 0;
  // Coupling: q = follow_ratio * (q of joint `follows`) + follow_offset, each moves the other. Empty: moves by itself.
  std::string follows;
  double follow_ratio = 1;
  double follow_offset = 0;
  // Of a body that is joined to another: where the joint lets go of it, for good. Infinite: nowhere.
  double lets_go = std::numeric_limits<double>::infinity();
};

struct Part {
  std::string name;
  int parent = -1;  // index in Body::parts, smaller than its own; -1: the base part
  Joint joint;      // unused for the base part
  std::vector<Shape> shapes;
  double mass = 0;                           // kg; the base part of a fixed body may have 0
  Vector3 centre_of_mass = Vector3::Zero();  // in the part's frame
  Matrix3 inertia = Matrix3::Zero();         // about the centre of mass, in the part's axes, kg m^2
  Surface surface;
  int instance = 0;  // value in instance masks; 0: not numbered yet, or never in them (see masks.h)
};

// Part 0 stands still or is free; further parts move on joints: furniture, the robot; a remote control with its
// buttons. A free body of one part may be joined to a part of an earlier body by the joint of its part 0, until that
// lets go of it: the cap of a bottle. Then `world_from_body` follows from where that part is.
struct Body {
  std::string name;
  bool free = false;
  std::string joined_to = {};  // the other body; empty: it is joined to none
  int joined_part = 0;
  bool fixture = false;  // of the world, there in each of its tasks
  std::vector<Part> parts;
  Transform world_from_body = Transform::Identity();  // of part 0, at the start
  int part_index(std::string_view part_name) const;   // -1 when there is none
};

// A named box without mass or contact, fixed to a part (or to the world: body empty).
struct Region {
  std::string name;
  std::string body;
  int part = 0;
  Transform part_from_region = Transform::Identity();  // centre of the box
  Vector3 size = Vector3::Zero();                      // full edge lengths, m
  bool visible = false;
  Colour colour;
  int instance = 0;  // value in instance masks, when visible
};

// A pinhole camera, with the lens distortion of Brown (Photogrammetric Engineering 1966) where a real one was
// calibrated. Optical frame: x right, y down, z forward. Pixels: u right, v down from the upper left corner of the
// picture, so the centre of the first pixel is (0.5, 0.5), and u = focal_x * x / z + centre_x.
struct Camera {
  std::string name;
  std::string mount_body;  // empty: fixed to the world
  int mount_part = 0;
  Transform mount_from_camera = Transform::Identity();
  int width = 128, height = 128;              // pixels
  double focal_x = 175.84, focal_y = 175.84;  // pixels, positive
  double centre_x = 64, centre_y = 64;        // pixels
  std::array<double, 5> distortion{};         // k1 k2 p1 p2 k3; all 0: none
  double near_m = 0.01, far_m = 4.5;          // along z
};

enum class TextureKind { image, checker, stripes, noise };

// What covers a shape. A mesh with texture coordinates wears an image by them; everything else is covered along the
// three axes of the shape's frame, one repeat each `size_m`.
struct Texture {
  TextureKind kind = TextureKind::image;
  std::shared_ptr<const Image> image;            // kind image
  Colour first{1, 1, 1, 1}, second{0, 0, 0, 1};  // the other kinds
  double size_m = 0.1;
  int seed = 0;  // noise
};

// One lamp far away and light from everywhere. Diffuse light falls off with the cosine (Lambert).
struct Light {
  Vector3 direction{-0.35, 0.3, -1};  // in which it shines, world, any length
  Colour colour{1, 1, 1, 1};
  double ambient = 0.5, diffuse = 0.6, specular = 0.15;  // shares of full brightness
};

// Where a hand may take an object. Frames: tip = the tool centre point, z out of the hand, y along the closing axis.
struct Grasp {
  Transform object_from_tip = Transform::Identity();
  double width = 0.04;     // opening at contact, m
  double approach = 0.08;  // retreat along the tip's -z, m
  double force = 20;       // N
};

// What planners, facts and people call a thing. It names a body, a part of one, a region, or the hand.
enum class ObjectKind { body, part, region, hand };
std::string_view to_string(ObjectKind kind);
std::optional<ObjectKind> object_kind_from(std::string_view name);
struct Object {
  std::string name;  // `block1`, `chest.top_drawer`
  ObjectKind kind = ObjectKind::body;
  std::string class_name;  // the Lua object file it comes from
  std::string type;        // PDDL type
  std::vector<std::string> traits;
  std::map<std::string, std::string> attributes;
  std::string body;  // of kind body and part; for a region see Region
  int part = 0;
  Vector3 size = Vector3::Zero();         // bounding box in its own frame, m
  std::vector<Grasp> grasps;              // authored; empty: from geometry
  std::map<std::string, double> numbers;  // authored numbers: open_at, press_depth …
};

struct JointLimits {
  double lower = 0, upper = 0;  // rad
  double velocity = 0;          // rad/s
  double acceleration = 0;      // rad/s^2
  double jerk = 0;              // rad/s^3
  double effort = 0;            // N m
};

// A fixed body whose listed joints are driven. Parts are indices into body.parts; a joint is named by its part.
struct Robot {
  std::string name;
  Body body;
  std::vector<int> arm;             // driven parts from base to tip
  std::vector<JointLimits> limits;  // one per arm part
  std::vector<double> home;         // rad, one per arm part
  std::vector<int> fingers;         // two sliders, coupled: both positive when open
  std::vector<int> pads;            // the parts whose contact counts as touch
  int tip_part = 0;
  Transform tip_part_from_tip = Transform::Identity();
  double opening_max = 0.08;                       // m, both fingers together
  double grip_force = 20;                          // N
  double finger_speed = 0.1;                       // m/s per finger
  std::string hand = "hand";                       // its object's name is NAME.hand
  std::vector<std::pair<int, int>> checked_pairs;  // part pairs that self-collision tests; the rest never meet
};
std::vector<std::string> arm_joints(const Robot& robot);  // names in its URDF, from base to tip

// What is measured beside the frames. kind `force_torque`: what contacts do to robot part `part` and all parts beyond
// it (see World::contact_wrench), in that part's frame: force_x force_y force_z N, torque_x torque_y torque_z N m, the
// mean over each period. kind `joint_torque`: the effort of each joint of the arm at the end of each period, N m (or
// N).
struct Sensor {
  std::string name, kind;
  int part = 0;       // of the robot; force_torque
  int rate_hz = 120;  // divides physics_hz
};

struct Scene {
  std::string world;
  Robot robot;
  std::vector<Body> bodies;  // fixtures first, then objects, in name order; never the robot
  std::vector<Region> regions;
  std::vector<Camera> cameras;
  std::vector<Sensor> sensors;  // in name order
  Light light;
  std::map<std::string, std::shared_ptr<const DrawnMesh>> meshes;  // by the hash of their content
  std::map<std::string, Texture> textures;                         // by name
  std::vector<std::string> classes;  // semantic classes in use: the first is 1 in semantic masks (see masks.h)
  std::vector<Object> objects;       // symbolic, sorted by name
  Vector3 gravity{0, 0, -9.81};
  int physics_hz = 240;
  int frame_hz = 20;

  int body_index(std::string_view name) const;  // -1: none; the robot is not among bodies
  const Body& body_at(int index) const;         // below 0: the robot's
  int region_index(std::string_view name) const;
  const Object* object(std::string_view name) const;
};

// What a joint does to what moves on it: the part's frame at a position, as seen from where it is at 0.
Transform joint_motion(const Joint& joint, double position);
double lead_of(const Joint& joint);  // of a screw, m/rad; else 0

// What the attribute part_name says of `drawer` and, as a word that PDDL can write, of `drawer.space`: drawer--space.
std::string part_name_of(std::string_view name);

// Solid inertia of convex shapes of uniform density together weighing `mass` (kg): sets centre and inertia.
void set_uniform_mass(Part& part, double mass);

// Axis-aligned bounding box of a part's shapes in the part's frame. Shapes: {lower, upper}, m.
std::array<Vector3, 2> bounding_box(const Part& part);

// The canonical document: same scene, same bytes; from(to(scene)) is the identity, to the last bit of every double.
std::string scene_to_document(const Scene& scene);
Scene scene_from_document(std::string_view document);  // throws Error

}  // namespace stampede
