#include "engine/model/urdf.h"

#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numbers>
#include <set>

#include "engine/base/error.h"
#include "engine/base/text_file.h"
#include "engine/geometry/mesh.h"
#include "engine/model/inertials.h"
#include "engine/model/urdf_files.h"

namespace stampede {
namespace {

// urdfdom reports to a process-wide log. While a thread captures, its messages go to it; others pass as before.
thread_local std::string* captured = nullptr;

class CapturingHandler : public console_bridge::OutputHandler {
 public:
  CapturingHandler() : previous_(console_bridge::getOutputHandler()) {}
  void log(const std::string& text, console_bridge::LogLevel level, const char* file, int line) override {
    if (captured == nullptr) {
      if (previous_ != nullptr) previous_->log(text, level, file, line);
      return;
    }
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (!captured->empty()) *captured += "; ";
    *captured += text;
  }

 private:
  console_bridge::OutputHandler* previous_;
};

class Capture {
 public:
  explicit Capture(std::string& text) {
    static CapturingHandler handler;
    static std::once_flag once;
    std::call_once(once, [] { console_bridge::useOutputHandler(&handler); });
    captured = &text;
  }
  ~Capture() { captured = nullptr; }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
};

constexpr std::uintmax_t kLargestFile = std::uintmax_t{16} << 20;  // bytes
constexpr int kMostElements = 10'000;  // both readers call themselves for what lies inside of what: this bounds it
constexpr int kMostLinks = 1'000;

std::string read_text(const std::filesystem::path& file) { return read_text_file(file, kLargestFile); }

// Exporters leave out what they do not know: no mass and no moment are 0, which is put right later.
bool complete_elements(TiXmlElement& inertial) {
  bool changed = false;
  const auto child = [&](const char* name, std::initializer_list<const char*> attributes) {
    TiXmlElement* element = inertial.FirstChildElement(name);
    if (element == nullptr) element = inertial.InsertEndChild(TiXmlElement(name))->ToElement();
    for (const char* attribute : attributes) {
      if (element->Attribute(attribute) != nullptr) continue;
      element->SetAttribute(attribute, "0");
      changed = true;
    }
  };
  child("mass", {"value"});
  child("inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});
  return changed;
}

std::string with_inertials(TiXmlDocument& xml, std::string text) {
  bool changed = false;
  TiXmlElement* robot = xml.FirstChildElement("robot");
  for (TiXmlElement* link = robot == nullptr ? nullptr : robot->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link"))
    if (TiXmlElement* inertial = link->FirstChildElement("inertial"); inertial != nullptr)
      changed |= complete_elements(*inertial);
  if (!changed) return text;
  TiXmlPrinter printer;
  xml.Accept(&printer);
  return printer.Str();
}

// Every `<` before a letter, in comments and values too: no reader sees more elements than that.
void check_count(const std::filesystem::path& file, const std::string& text) {
  int count = 0;
  for (std::size_t at = text.find('<'); at != std::string::npos && at + 1 < text.size(); at = text.find('<', at + 1))
    count += text[at + 1] != '/' && text[at + 1] != '!' && text[at + 1] != '?' ? 1 : 0;
  if (count > kMostElements)
    throw Error(
        file.string(),
        "it has " + std::to_string(count) + " XML elements; at most " + std::to_string(kMostElements) + " are read",
        "split the model");
}

// urdfdom hands what it reads to printf as the format when it complains of it.
void refuse_format(const std::filesystem::path& file, const TiXmlNode& node, const char* text) {
  if (text != nullptr && std::strchr(text, '%') != nullptr)
    throw Error(file.string() + ":" + std::to_string(node.Row()),
                "'" + std::string(text).substr(0, 60) + "' has a '%', which names and numbers of a URDF cannot have",
                "choose another name");
}

void check_texts(const std::filesystem::path& file, const TiXmlNode& node) {
  if (node.Type() == TiXmlNode::TINYXML_COMMENT) return;
  refuse_format(file, node, node.Value());
  if (const TiXmlElement* element = node.ToElement(); element != nullptr) {
    for (const TiXmlAttribute* one = element->FirstAttribute(); one != nullptr; one = one->Next()) {
      refuse_format(file, node, one->Name());
      refuse_format(file, node, one->Value());
    }
  }
  for (const TiXmlNode* child = node.FirstChild(); child != nullptr; child = child->NextSibling())
    check_texts(file, *child);
}

void check_document(const std::filesystem::path& file, const TiXmlDocument& xml) {
  int links = 0;
  for (const TiXmlElement* root = xml.FirstChildElement(); root != nullptr; root = root->NextSiblingElement()) {
    for (const TiXmlElement* one = root->FirstChildElement(); one != nullptr; one = one->NextSiblingElement()) {
      const std::string kind = one->Value();
      links += kind == "link" ? 1 : 0;
      // What other programs keep in a URDF, urdfdom does not look at.
      if (kind == "link" || kind == "joint" || kind == "material") check_texts(file, *one);
    }
    for (const TiXmlAttribute* one = root->FirstAttribute(); one != nullptr; one = one->Next())
      refuse_format(file, *root, one->Value());
  }
  if (links > kMostLinks)
    throw Error(file.string(),
                "it has " + std::to_string(links) + " links; at most " + std::to_string(kMostLinks) + " are simulated",
                "join links that fixed joints connect");
}

urdf::ModelInterfaceSharedPtr parse_urdf(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  check_count(file, text);
  TiXmlDocument xml;  // urdfdom reads it again, but does not tell the line of a mistake
  xml.Parse(text.c_str());
  if (xml.Error()) {
    const auto last = 1 + std::count(text.begin(), text.end(), '\n');  // where it ends too early, it tells no row
    throw Error(file.string() + ":" + std::to_string(xml.ErrorRow() > 0 ? xml.ErrorRow() : last),
                std::string("malformed XML: ") + xml.ErrorDesc(), "close every element and quote every attribute");
  }
  check_document(file, xml);
  std::string messages;
  urdf::ModelInterfaceSharedPtr model;
  {
    const Capture capture(messages);
    try {
      model = urdf::parseURDF(with_inertials(xml, text));
    } catch (const std::exception& error) {
      messages += error.what();
    }
  }
  if (!model || !messages.empty())  // urdfdom goes on after some errors and leaves the element out
    throw Error(file.string(), messages.empty() ? "not a URDF model" : messages,
                "correct the element that is named; a URDF is one tree of links below <robot>");
  return model;
}

Transform from(const urdf::Pose& pose) {
  const auto& q = pose.rotation;
  return make_transform({pose.position.x, pose.position.y, pose.position.z}, Quaternion(q.w, q.x, q.y, q.z));
}

class UrdfReader {
 public:
  UrdfReader(const std::filesystem::path& file, const FileScope& scope, const urdf::ModelInterface& model)
      : file_(file), scope_(scope), model_(model) {}

  UrdfBody read(bool free) {
    body_.name = model_.getName();
    add(*model_.getRoot(), -1);
    if (body_.parts.size() != model_.links_.size())
      for (const auto& [name, link] : model_.links_)
        if (!seen_.contains(name))
          fail("link '" + name + "'", "does not hang on the root link '" + model_.getRoot()->name + "'",
               "connect it by a joint, without a cycle");
    if (!free)
      for (Error& one : complete_inertials(file_.string(), false, body_.parts)) remarks_.push_back(std::move(one));
    return {std::move(body_), std::move(drawn_), std::move(remarks_)};
  }

 private:
  [[noreturn]] void fail(const std::string& element, const std::string& what, const std::string& hint) const {
    throw Error(file_.string(), element + ": " + what, hint);
  }

  void add(const urdf::Link& link, int parent) {
    const std::string element = "link '" + link.name + "'";
    if (!seen_.insert(link.name).second)
      fail(element, "has two parents or lies on a cycle", "let each link be the child of one joint");
    Part part;
    part.name = link.name;
    part.parent = parent;
    if (parent >= 0) part.joint = read_joint(*link.parent_joint);
    read_inertia(link, part);
    add_shapes(link, element, part);
    const int index = static_cast<int>(body_.parts.size());
    body_.parts.push_back(std::move(part));
    for (const auto& child : link.child_links) add(*child, index);
  }

  Joint read_joint(const urdf::Joint& source) const {
    const std::string element = "joint '" + source.name + "'";
    Joint joint;
    joint.name = source.name;
    joint.parent_from_joint = from(source.parent_to_joint_origin_transform);
    joint.kind = kind_of(source, element);
    if (joint.kind == JointKind::fixed) return joint;
    joint.axis = {source.axis.x, source.axis.y, source.axis.z};
    if (!(joint.axis.norm() > 1e-6)) fail(element, "its axis has no length", "write <axis xyz=\"0 0 1\"/>");
    joint.axis.normalize();
    if (source.dynamics) {
      joint.damping = source.dynamics->damping;
      joint.friction = source.dynamics->friction;
    }
    if (source.limits) {
      joint.lower = source.limits->lower;
      joint.upper = source.limits->upper;
      joint.effort = source.limits->effort;
      joint.velocity = source.limits->velocity;
    }
    if (source.type == urdf::Joint::CONTINUOUS) {  // two turns either way stand for no end
      joint.upper = 4 * std::numbers::pi;
      joint.lower = -joint.upper;
    }
    if (joint.lower > joint.upper) fail(element, "its lower limit lies above its upper", "swap them");
    if (joint.damping < 0 || joint.friction < 0 || joint.effort < 0 || joint.velocity < 0)
      fail(element, "damping, friction, effort and velocity cannot be negative", "give 0 or more");
    joint.initial = std::min(std::max(0.0, joint.lower), joint.upper);
    if (source.mimic && !model_.getJoint(source.mimic->joint_name))
      fail(element, "mimics joint '" + source.mimic->joint_name + "', which does not exist",
           "name a joint of this file");
    return joint;
  }

  JointKind kind_of(const urdf::Joint& source, const std::string& element) const {
    switch (source.type) {
      case urdf::Joint::FIXED:
        return JointKind::fixed;
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        return JointKind::hinge;
      case urdf::Joint::PRISMATIC:
        return JointKind::slider;
      default:
        fail(element, "floating and planar joints are not supported", "use revolute, continuous, prismatic or fixed");
    }
  }

  void read_inertia(const urdf::Link& link, Part& part) const {
    if (!link.inertial) return;
    const std::string element = "link '" + link.name + "'";
    const urdf::Inertial& source = *link.inertial;
    const Transform part_from_inertia = from(source.origin);
    Matrix3 inertia;
    inertia << source.ixx, source.ixy, source.ixz, source.ixy, source.iyy, source.iyz, source.ixz, source.iyz,
        source.izz;
    const Matrix3 rotation = part_from_inertia.linear();
    part.mass = source.mass;
    part.centre_of_mass = part_from_inertia.translation();
    part.inertia = source.origin.rotation.w == 1.0 ? inertia : Matrix3(rotation * inertia * rotation.transpose());
    if (!std::isfinite(part.mass) || !inertia.allFinite() || !part_from_inertia.matrix().allFinite())
      fail(element, "its mass, inertia and origin must be finite numbers", "correct its <inertial>");
    if (part.mass < 0) fail(element, "its mass is negative", "correct its <inertial>: kg, 0 or above");
  }

  void add_shapes(const urdf::Link& link, const std::string& element, Part& part) {
    const bool has_visuals = !link.visual_array.empty();
    for (const auto& collision : link.collision_array) {
      Shape shape;
      shape.visible = !has_visuals;
      shape.part_from_shape = from(collision->origin);
      add_geometry(collision->geometry.get(), element, shape, {}, part);
    }
    for (const auto& visual : link.visual_array) {
      Shape shape;
      shape.collides = false;
      shape.part_from_shape = from(visual->origin);
      const std::optional<Looks> looks = looks_of(visual->material.get(), element);
      if (looks) {
        shape.colour = looks->colour;
        shape.texture = looks->texture;
      }
      add_geometry(visual->geometry.get(), element, shape, looks, part);
    }
  }

  std::optional<Looks> looks_of(const urdf::Material* material, const std::string& element) {
    if (material == nullptr) return std::nullopt;
    const urdf::Color& c = material->color;
    Looks looks{{c.r, c.g, c.b, c.a}, {}};
    const std::string& name = material->texture_filename;
    if (name.empty()) return looks;
    if (c.r == 0 && c.g == 0 && c.b == 0) looks.colour = {1, 1, 1, 1};  // what urdfdom says for no colour at all
    guarded(element, "texture", [&] {
      Texture texture;
      const std::filesystem::path picture = file_named(name, file_, scope_);
      scope_.check(picture);
      texture.image = std::make_shared<const Image>(load_image(picture));
      looks.texture = drawn_.add(std::filesystem::path(name).filename().string(), texture);
    });
    return looks;
  }

  // An error of a file that the URDF names says so.
  template <typename Work>
  void guarded(const std::string& element, const std::string& what, const Work& work) const {
    try {
      work();
    } catch (const Error& error) {
      fail(element, what + " " + error.where() + ": " + error.message(), error.hint());
    }
  }

  void add_geometry(const urdf::Geometry* geometry, const std::string& element, Shape shape,
                    const std::optional<Looks>& looks, Part& part) {
    if (const auto* box = dynamic_cast<const urdf::Box*>(geometry)) {
      shape.kind = ShapeKind::box;
      shape.size = {box->dim.x, box->dim.y, box->dim.z};
      if (!(shape.size.minCoeff() > 0)) fail(element, "a box needs three sizes above 0", "correct its <box size>");
    } else if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(geometry)) {
      shape.kind = ShapeKind::sphere;
      shape.radius = sphere->radius;
      if (!(shape.radius > 0)) fail(element, "a sphere needs a radius above 0", "correct its <sphere radius>");
    } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(geometry)) {
      shape.kind = ShapeKind::cylinder;
      shape.radius = cylinder->radius;
      shape.length = cylinder->length;
      if (!(shape.radius > 0 && shape.length > 0))
        fail(element, "a cylinder needs a radius and a length above 0", "correct its <cylinder>");
    } else if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(geometry)) {
      return add_mesh(*mesh, element, shape, looks, part);
    } else {
      fail(element, "a shape without geometry", "use <box>, <sphere>, <cylinder> or <mesh>");
    }
    part.shapes.push_back(std::move(shape));
  }

  // Hulls to collide with, and the mesh itself to be seen.
  void add_mesh(const urdf::Mesh& mesh, const std::string& element, Shape shape, const std::optional<Looks>& looks,
                Part& part) {
    const Vector3 scale(mesh.scale.x, mesh.scale.y, mesh.scale.z);
    const bool seen = shape.visible;
    guarded(element, "mesh", [&] {
      const std::filesystem::path file = file_named(mesh.filename, file_, scope_);
      if (const std::string remark = mesh_remark(file); !remark.empty() && remarked_.insert(file).second)
        remarks_.emplace_back(file_.string(), element + ": mesh " + file.string() + ": " + remark, kUpAxisCure);
      if (shape.collides) {
        shape.kind = ShapeKind::hull;
        shape.visible = false;
        for (auto& points : load_hulls(file, scale, kHullPoints, scope_)) {
          shape.points = std::move(points);
          part.shapes.push_back(shape);
        }
      }
      if (!seen) return;
      const auto pieces = add_drawn(drawn_, file.filename().string(), load_drawn(file, scale, scope_));
      for (Shape& drawn : drawn_shapes(pieces, shape, looks)) part.shapes.push_back(std::move(drawn));
    });
  }

  const std::filesystem::path& file_;
  const FileScope& scope_;
  const urdf::ModelInterface& model_;
  Body body_;
  DrawnAssets drawn_;
  std::vector<Error> remarks_;
  std::set<std::filesystem::path> remarked_;
  std::set<std::string> seen_;
};

}  // namespace

UrdfBody read_urdf(const std::filesystem::path& file) { return read_urdf(file, beside(file)); }

UrdfBody read_urdf(const std::filesystem::path& file, const FileScope& scope, bool free) {
  scope.check(file);
  const urdf::ModelInterfaceSharedPtr model = parse_urdf(file);
  return UrdfReader(file, scope, *model).read(free);
}

}  // namespace stampede
