#include "scripting/runtime/body_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/model/inertials.h"
#include "engine/model/kinematics.h"
#include "scripting/runtime/evaluate.h"

namespace stampede {
namespace {

constexpr double kTiny = 1e-12;

// The kind of joint and the table that describes it: slider, hinge or screw = { … }; else fixed.
std::pair<JointKind, const Value*> joint_of(const Value& part) {
  if (part["screw"].kind == Value::Kind::table) return {JointKind::screw, &part["screw"]};
  if (part["hinge"].kind == Value::Kind::table) return {JointKind::hinge, &part["hinge"]};
  if (part["slider"].kind == Value::Kind::table) return {JointKind::slider, &part["slider"]};
  if (part["fixed"].kind == Value::Kind::table) return {JointKind::fixed, &part["fixed"]};
  return {JointKind::fixed, &part};
}

void read_range(const Value& value, Joint& joint) {
  const std::vector<double> range = value["range"].present() ? value["range"].as_numbers() : std::vector<double>{};
  if (range.size() != 2 || range[0] > range[1]) {
    throw Error(value.place, "a moving joint needs range = { lower, upper }");
  }
  joint.lower = range[0];
  joint.upper = range[1];
  joint.initial = value.number_or("initial", std::clamp(0.0, joint.lower, joint.upper));
  if (joint.initial < joint.lower || joint.initial > joint.upper) {
    throw Error(value.place, "initial lies outside range");
  }
}

Joint joint_from(const Value& part, const std::string& name) {
  const auto [kind, value] = joint_of(part);
  Joint joint;
  joint.name = name;
  joint.kind = kind;
  joint.parent_from_joint = transform_from(*value);
  if (kind == JointKind::fixed) return joint;
  joint.axis = value->vector_or("axis", Vector3::UnitZ());
  if (joint.axis.norm() < kTiny) throw Error(value->place, "axis must not be zero");
  joint.axis.normalize();
  read_range(*value, joint);
  if (kind == JointKind::screw) {
    joint.pitch = (*value)["pitch"].as_number();
    if (joint.pitch == 0) throw Error((*value)["pitch"].place, "a screw travels as it turns: its pitch is not 0");
  }
  if (const Value& lets_go = (*value)["lets_go"]; lets_go.present()) {
    joint.lets_go = lets_go.as_number();
    if (joint.lets_go == joint.initial || joint.lets_go < joint.lower || joint.lets_go > joint.upper)
      lets_go.expected("a position within its range that is not the first");
  }
  // Never zero: without friction and damping, drawers rebound from their stops.
  const bool slider = kind == JointKind::slider;
  const Value& follows = (*value)["follows"];
  joint.damping = value->number_or("damping", follows.present() ? 0 : slider ? 5 : 0.2);
  joint.friction = value->number_or("friction", follows.present() ? 0 : slider ? 2 : 0.3);
  joint.spring_force = value->number_or("spring", 0);
  joint.spring_target = value->number_or("spring_target", joint.lower);
  joint.stiffness = value->number_or("stiffness", 0);
  joint.detent = value->number_or("detent", 0);
  if (follows.present()) {
    joint.follows = follows["part"].as_text();
    joint.follow_ratio = follows.number_or("ratio", 1);
    joint.follow_offset = follows.number_or("offset", 0);
  }
  if (const Value& latch = (*value)["latch"]; latch.present()) {
    joint.latch_key = latch["key"].as_text();
    joint.latch_open = latch["open"].as_number();
    joint.latch_close = latch.number_or("close", 0);
  }
  return joint;
}

Grasp grasp_from(const Value& value) {
  Grasp grasp;
  grasp.object_from_tip = value["pose"].kind == Value::Kind::pose ? value["pose"].pose : transform_from(value);
  grasp.width = value.number_or("width", grasp.width);
  grasp.approach = value.number_or("approach", grasp.approach);
  grasp.force = value.number_or("force", grasp.force);
  return grasp;
}

class Builder {
 public:
  Builder(const ObjectSource& source, const Colours& colours)
      : source_(source),
        colours_(colours),
        own_assets_(FileScope({source.folder})),
        assets_(source.assets != nullptr ? *source.assets : own_assets_),
        context_{colours, source.folder, assets_, result_.drawn, source.name} {}

  BuiltObject build() {
    const Value& fields = source_.fields;
    result_.placed = fields["at"].present();
    if (const Value& region = fields["region"]; region.present()) return whole_region(region);
    Body body;
    body.name = source_.name;
    body.world_from_body = transform_from(fields);
    body.free = is_free(fields);
    if (fields["urdf"].present()) {
      const UrdfBody& urdf = assets_.urdf(source_.folder / fields["urdf"].as_text(), body.free);
      body.parts = urdf.body.parts;
      result_.drawn.join(urdf.drawn);
    } else {
      body.parts.push_back(part_from(fields, "base", std::nullopt));
    }
    add_parts(fields, body);
    set_joints(fields["joints"], body);
    start_followers(body);
    result_.stands_still = !body.free;
    join_loose(body);
    if (body.free && fields["urdf"].present()) weigh(fields, body);
    check_size(fields, body);
    if (body.free && !(body.parts[0].mass > 0)) {
      const std::string& place = fields["mass"].present() ? fields["mass"].place : fields.place;
      throw Error(place, "'" + source_.name + "' can move, so it needs a mass", "mass = 0.1 (kg)");
    }
    name_things(fields, body);
    result_.body = std::move(body);
    return std::move(result_);
  }

 private:
  // What moves needs a mass: its file's, the author's, or what its shapes say.
  void weigh(const Value& fields, Body& body) const {
    const double mass = fields.number_or("mass", 0);
    if (!(body.parts[0].mass > 0) && mass > 0 && enclosed_volume(body.parts[0]) > 0)
      set_uniform_mass(body.parts[0], mass);
    const std::string file = (source_.folder / fields["urdf"].as_text()).string();
    for (const Error& remark : complete_inertials(file, true, body.parts)) assets_.remark(remark);
  }

  // Files in millimetres are a thousand times too large; what was scaled twice is too small to be seen.
  void check_size(const Value& fields, const Body& body) const {
    constexpr double kLargestMovable = 2, kLargestThing = 100, kUnusual = 5, kSmallest = 0.001;  // m
    std::vector<double> positions;
    for (const Part& part : body.parts) positions.push_back(part.parent < 0 ? 0 : part.joint.initial);
    std::vector<Transform> body_from_part;
    forward_kinematics(body, Transform::Identity(), positions, body_from_part);
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t i = 0; i < body.parts.size(); ++i) {
      if (body.parts[i].shapes.empty()) continue;
      const auto [lower, upper] = bounding_box(body.parts[i]);
      const Vector3 reach = 0.5 * (body_from_part[i].linear().cwiseAbs() * (upper - lower));
      const Vector3 centre = body_from_part[i] * Vector3(0.5 * (lower + upper));
      low = low.cwiseMin(centre - reach);
      high = high.cwiseMax(centre + reach);
    }
    const Vector3 size = high - low;
    if (!(size.maxCoeff() > -1)) return;  // nothing to be seen
    const double largest = size.maxCoeff();
    const std::string text = "it is " + metres(size.x()) + " x " + metres(size.y()) + " x " + metres(size.z()) + " m";
    const std::string cure =
        fields["urdf"].present()
            ? "sizes are in metres: scale=\"0.001 0.001 0.001\" at the URDF's meshes in millimetres"
            : "sizes are in metres: of a file in millimetres, mesh { \"…\", scale = 0.001 }";
    if (!(largest <= (body.free ? kLargestMovable : kLargestThing)))
      throw Error(fields.place, text + (body.free ? ": too large to be moved" : ": too large for a scene"), cure);
    if (largest < kSmallest)
      throw Error(fields.place, text + ": too small for a scene", "is it scaled twice? Sizes are in metres");
    if (largest > kUnusual) assets_.remark({fields.place, text, cure});
  }

  static std::string metres(double length) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", length);
    return text;
  }

  BuiltObject whole_region(const Value& value) {
    Region region;
    region.name = source_.name;
    region.part_from_region = transform_from(source_.fields);
    describe_region(value, source_.fields, region);
    Object object = named(source_.fields, source_.name, ObjectKind::region, "region");
    object.size = region.size;
    result_.regions.push_back(region);
    result_.objects.push_back(object);
    return std::move(result_);
  }

  void describe_region(const Value& value, const Value& looks, Region& region) {
    region.size = value["size"].as_vector();
    if (region.size.minCoeff() < 0) value["size"].expected("edge lengths that are not negative");
    region.visible = looks.boolean_or("visible", value.boolean_or("visible", false));
    const Value& colour = looks["colour"];
    region.colour = colour.present() ? colour_from(colour, colours_) : Colour{0.7, 0.7, 0.7, 0.4};
  }

  Part part_from(const Value& fields, const std::string& name, const std::optional<Looks>& outer) const {
    Part part;
    part.name = name;
    part.shapes = shapes_from(fields, looks_from(fields, outer, context_), context_);
    part.surface = surface_from(fields, Surface{});
    const double mass = fields.number_or("mass", 0);
    if (mass < 0) fields["mass"].expected("a mass that is not negative");
    if (mass > 0) set_uniform_mass(part, mass);
    return part;
  }

  // Parts in an order in which parents come first, else by name.
  std::vector<std::pair<std::string, const Value*>> parts_in_order(const Value& fields) const {
    std::vector<std::pair<std::string, const Value*>> parts;
    for (const auto& [name, value] : fields["parts"].fields) parts.emplace_back(name, &value);
    for (const Value& value : fields["parts"].items) parts.emplace_back(value["name"].as_text(), &value);
    return parts;
  }

  void add_parts(const Value& fields, Body& body) {
    auto waiting = parts_in_order(fields);
    const std::optional<Looks> looks = looks_from(fields, std::nullopt, context_);
    while (!waiting.empty()) {
      const auto ready = std::find_if(waiting.begin(), waiting.end(), [&body](const auto& entry) {
        const std::string parent = entry.second->text_or("parent", "");
        return parent.empty() || body.part_index(entry.first) >= 0 || body.part_index(parent) >= 0;
      });
      if (ready == waiting.end()) {
        const Value& parent = (*waiting.front().second)["parent"];
        throw Error(parent.place, "there is no part '" + parent.as_text() + "' above '" + waiting.front().first + "'");
      }
      add_part(ready->first, *ready->second, looks, body);
      waiting.erase(ready);
    }
  }

  void add_part(const std::string& name, const Value& fields, const std::optional<Looks>& looks, Body& body) {
    if (const int known = body.part_index(name); known >= 0 && source_.fields["urdf"].present()) {
      body.parts[static_cast<std::size_t>(known)].surface =
          surface_from(fields, body.parts[static_cast<std::size_t>(known)].surface);
      return;  // a link of the URDF: parts add names, traits and regions to it
    }
    Part part = part_from(fields, name, looks);
    const std::string parent = fields.text_or("parent", "");
    part.parent = parent.empty() ? 0 : body.part_index(parent);
    part.joint = joint_from(fields, name);
    if (part.joint.kind != JointKind::fixed && !(part.mass > 0)) {
      throw Error(fields.place, "'" + name + "' moves, so it needs a mass", "mass = 1 (kg)");
    }
    if (std::isfinite(part.joint.lets_go)) return add_loose(name, std::move(part));
    body.parts.push_back(std::move(part));
  }

  // A part whose joint lets go of it is a body of its own.
  void add_loose(const std::string& name, Part part) {
    Body loose;
    loose.name = source_.name + "." + name;
    loose.free = true;
    loose.joined_to = source_.name;
    loose.joined_part = part.parent;
    part.parent = -1;
    loose.parts.push_back(std::move(part));
    result_.loose.push_back(std::move(loose));
  }

  const Body* loose(const std::string& name) const {
    const auto found = std::find_if(result_.loose.begin(), result_.loose.end(),
                                    [&](const Body& body) { return body.name == source_.name + "." + name; });
    return found == result_.loose.end() ? nullptr : &*found;
  }

  void join_loose(const Body& body) {
    std::vector<double> positions;
    for (const Part& part : body.parts) positions.push_back(part.parent < 0 ? 0 : part.joint.initial);
    std::vector<Transform> world_from_part;
    forward_kinematics(body, body.world_from_body, positions, world_from_part);
    for (Body& one : result_.loose) {
      const Joint& joint = one.parts[0].joint;
      one.world_from_body = world_from_part[static_cast<std::size_t>(one.joined_part)] * joint.parent_from_joint *
                            joint_motion(joint, joint.initial);
    }
  }

  // What follows another joint starts where that puts it; chains are followed to their end.
  static void start_followers(Body& body) {
    for (std::size_t links = 1; links < body.parts.size(); ++links)
      for (Part& part : body.parts) {
        Joint& joint = part.joint;
        const int leader = joint.follows.empty() ? -1 : body.part_index(joint.follows);
        if (leader < 0) continue;
        const double there = body.parts[static_cast<std::size_t>(leader)].joint.initial;
        joint.initial = std::clamp(joint.follow_ratio * there + joint.follow_offset, joint.lower, joint.upper);
      }
  }

  // joints = { top_drawer = 0.1 }: where parts are at the start.
  void set_joints(const Value& positions, Body& body) const {
    for (const auto& [name, value] : positions.fields) {
      const int index = body.part_index(name);
      if (index < 0 && loose(name) != nullptr) value.expected("no start: what lets go starts where its file says");
      if (index < 0) throw Error(value.place, "'" + source_.name + "' has no part '" + name + "'");
      Joint& joint = body.parts[static_cast<std::size_t>(index)].joint;
      joint.initial = value.as_number();
      if (joint.initial < joint.lower || joint.initial > joint.upper) value.expected("a position within its range");
    }
  }

  static bool is_free(const Value& fields) {
    const std::vector<std::string> traits =
        fields["traits"].present() ? fields["traits"].as_texts() : std::vector<std::string>{};
    const bool movable = std::find(traits.begin(), traits.end(), "movable") != traits.end();
    return !fields.boolean_or("fixed", !movable);
  }

  Object named(const Value& fields, const std::string& name, ObjectKind kind, std::string_view type) const {
    Object object;
    object.name = name;
    object.kind = kind;
    object.class_name = source_.class_name;
    object.type = fields.text_or("type", type);
    if (fields["traits"].present()) object.traits = fields["traits"].as_texts();
    std::sort(object.traits.begin(), object.traits.end());
    for (const auto& [key, value] : fields["attributes"].fields) {
      if (value.is_table()) value.expected("a plain value");
      object.attributes[key] = plain_text(value);
    }
    if (fields["colour"].kind == Value::Kind::text) object.attributes.emplace("colour", fields["colour"].text);
    for (const auto& [key, value] : fields["numbers"].fields) object.numbers[key] = value.as_number();
    for (const Value& grasp : fields["grasps"].items) object.grasps.push_back(grasp_from(grasp));
    return object;
  }

  // What every part and region is known by: formulas name `?x.lid`.
  void name_whole(Object& object) const {
    object.attributes.emplace("part_of", source_.name);
    object.attributes.emplace("part_name", part_name_of(object.name.substr(source_.name.size() + 1)));
  }

  void name_part(const Value& fields, const std::string& name, ObjectKind kind, const Body& body, int index) {
    const Part& part = body.parts[static_cast<std::size_t>(index)];
    Object object = named(fields, name, kind, kind == ObjectKind::part ? "part" : "thing");
    object.body = body.name;
    object.part = index;
    if (name != source_.name) name_whole(object);
    if (!part.shapes.empty()) {
      const auto [lower, upper] = bounding_box(part);
      object.size = upper - lower;
    }
    result_.objects.push_back(object);
  }

  void name_regions(const Value& fields, const std::string& owner, const std::string& body, int index) {
    for (const auto& [key, value] : fields["regions"].fields) {
      Region region;
      region.name = owner + "." + key;
      region.body = body;
      region.part = index;
      region.part_from_region = transform_from(value);
      describe_region(value, value, region);
      Object object = named(value, region.name, ObjectKind::region, "region");
      object.body = body;
      object.part = index;
      object.size = region.size;
      name_whole(object);
      result_.objects.push_back(object);
      result_.regions.push_back(region);
    }
  }

  // Where a tool acts is a region without volume.
  void name_tip(const Value& fields, const Body& body) {
    constexpr double kOff_m = 0.005;
    const Value& tip = fields["tip"];
    if (!tip.present()) return;
    Region region;
    region.name = source_.name + ".tip";
    region.body = source_.name;
    region.part_from_region = transform_from(tip);
    const auto [lower, upper] = bounding_box(body.parts[0]);
    const Vector3 at = region.part_from_region.translation();
    const double off = (lower - at).cwiseMax(at - upper).cwiseMax(0.0).norm();
    if (off > kOff_m)
      throw Error(tip.place,
                  "the tip is " + std::to_string(static_cast<int>(std::lround(1000 * off))) + " mm outside the tool",
                  "its shapes reach from " + corner_text(lower) + " to " + corner_text(upper) + " m: move `at` there");
    Object object = named(Value{}, region.name, ObjectKind::region, "region");
    object.body = source_.name;
    name_whole(object);
    result_.objects.push_back(object);
    result_.regions.push_back(region);
  }

  static std::string corner_text(const Vector3& corner) {
    const auto number = [](double value) { return plain_text_of(std::round(1000 * value) / 1000); };
    return "{ " + number(corner.x()) + ", " + number(corner.y()) + ", " + number(corner.z()) + " }";
  }
  static std::string plain_text_of(double value) {
    Value number;
    number.kind = Value::Kind::number;
    number.number = value;
    return plain_text(number);
  }

  void name_things(const Value& fields, const Body& body) {
    name_part(fields, source_.name, ObjectKind::body, body, 0);
    name_regions(fields, source_.name, source_.name, 0);
    name_tip(fields, body);
    for (const auto& [key, value] : parts_in_order(fields)) {
      const Body* own = loose(key);
      const Body& carrier = own != nullptr ? *own : body;
      const int index = own != nullptr ? 0 : body.part_index(key);
      const std::string name = source_.name + "." + key;
      // A part without a type or traits is nothing that people or plans speak of.
      if (own != nullptr || (*value)["type"].present() || (*value)["traits"].present()) {
        name_part(*value, name, own != nullptr ? ObjectKind::body : ObjectKind::part, carrier, index);
      }
      name_regions(*value, name, carrier.name, index);
    }
  }

  const ObjectSource& source_;
  const Colours& colours_;
  BuiltObject result_;
  Assets own_assets_;
  Assets& assets_;
  ShapeContext context_;
};

}  // namespace

BuiltObject build_object(const ObjectSource& source, const Colours& colours) {
  return Builder(source, colours).build();
}

}  // namespace stampede
