#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/geometry/mesh.h"
#include "scripting/runtime/body_builder.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 8> kShapeWords = {"box",  "sphere", "cylinder", "capsule",
                                                         "cone", "hull",   "lathe",    "mesh"};

// A shape is written box{ x, y, z } or { box = { x, y, z }, … }. Result: its word and the table with the numbers.
std::pair<std::string, const Value*> shape_word(const Value& value) {
  if (value.kind != Value::Kind::table) value.expected("a shape such as box { x, y, z }");
  const std::string tag = value.text_or("shape", "");
  for (const std::string_view word : kShapeWords) {
    if (tag == word) return {tag, &value};
    if (value[word].present()) return {std::string(word), &value[word]};
  }
  throw Error(value.place, "this is no shape", "one of box sphere cylinder capsule cone hull lathe mesh");
}

double dimension(const Value& numbers, const Value& whole, std::size_t index, std::string_view field) {
  double size = 0;
  if (numbers.kind == Value::Kind::number && index == 0) {
    size = numbers.number;
  } else if (index < numbers.items.size()) {
    size = numbers.items[index].as_number();
  } else {
    const Value& named = numbers[field].present() ? numbers[field] : whole[field];
    if (!named.present()) throw Error(whole.place, "a shape without its " + std::string(field));
    size = named.as_number();
  }
  if (!(size > 0)) throw Error(whole.place, std::string(field) + " must be positive");
  return size;
}

std::vector<Vector3> points_from(const Value& list) {
  std::vector<Vector3> points;
  const Value& points_list = list["points"].present() ? list["points"] : list;
  for (const Value& item : points_list.items) points.push_back(item.as_vector());
  if (points.size() < 4) list.expected("at least four points");
  return points;
}

struct Ring {
  double outer, inner, z;
};

std::vector<Ring> rings_from(const Value& list) {
  const double wall = list.number_or("wall", 0);
  const Value& profile = list["profile"].present() ? list["profile"] : list;
  std::vector<Ring> rings;
  for (const Value& item : profile.items) {
    const std::vector<double> numbers = item.as_numbers();
    if (numbers.size() != 2) item.expected("{ radius, z }");
    rings.push_back({numbers[0], wall > 0 ? std::max(0.0, numbers[0] - wall) : 0.0, numbers[1]});
  }
  if (rings.size() < 2) list.expected("a profile of at least two { radius, z }");
  return rings;
}

// A profile turned about z. Solid: one convex band between two rings; with a wall: wedges, for a ring is not convex.
std::vector<std::vector<Vector3>> lathe_hulls(const Value& list) {
  const std::vector<Ring> rings = rings_from(list);
  const int sides = static_cast<int>(std::clamp(list.number_or("segments", 16), 3.0, 64.0));
  const bool hollow = list.number_or("wall", 0) > 0;
  const auto at = [&](double radius, int side, double z) {
    const double angle = 2 * std::numbers::pi * side / sides;
    return Vector3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  std::vector<std::vector<Vector3>> hulls;
  for (std::size_t band = 0; band + 1 < rings.size(); ++band) {
    for (int side = 0; side < (hollow ? sides : 1); ++side) {
      std::vector<Vector3> points;
      for (const Ring& ring : {rings[band], rings[band + 1]}) {
        if (hollow) {
          for (const double radius : {ring.inner, ring.outer}) {
            points.push_back(at(radius, side, ring.z));
            points.push_back(at(radius, side + 1, ring.z));
          }
        } else {
          for (int corner = 0; corner < sides; ++corner) points.push_back(at(ring.outer, corner, ring.z));
        }
      }
      hulls.push_back(std::move(points));
    }
  }
  return hulls;
}

std::vector<std::vector<Vector3>> mesh_hulls(const Value& numbers, const Value& whole,
                                             const std::filesystem::path& folder) {
  const Value& named = numbers.kind == Value::Kind::text ? numbers
                       : !numbers.items.empty()          ? numbers.items[0]
                                                         : numbers["file"];
  const Value& scale = numbers["scale"].present() ? numbers["scale"] : whole["scale"];
  const Vector3 factor = !scale.present()                    ? Vector3(Vector3::Ones())
                         : scale.kind == Value::Kind::number ? Vector3(Vector3::Constant(scale.number))
                                                             : scale.as_vector();
  return load_hulls(folder / named.as_text(), factor);
}

}  // namespace

Colour colour_from(const Value& value, const Colours& colours) {
  if (value.kind == Value::Kind::text) {
    const auto found = colours.find(value.text);
    if (found == colours.end()) throw Error(value.place, "there is no colour '" + value.text + "' in colours.lua");
    return found->second;
  }
  const std::vector<double> numbers = value.as_numbers();
  if (numbers.size() < 3 || numbers.size() > 4) value.expected("a colour's name or { red, green, blue [, alpha] }");
  return {numbers[0], numbers[1], numbers[2], numbers.size() == 4 ? numbers[3] : 1.0};
}

Surface surface_from(const Value& fields, const Surface& otherwise) {
  const Value& group = fields["contact"].present() ? fields["contact"] : fields;
  Surface surface = otherwise;
  if (group["friction"].kind == Value::Kind::number) surface.friction = group["friction"].number;
  surface.rolling = group.number_or("rolling", surface.rolling);
  surface.spinning = group.number_or("spinning", surface.spinning);
  surface.restitution = group.number_or("restitution", surface.restitution);
  surface.anchor = group.boolean_or("anchor", surface.anchor);
  return surface;
}

namespace {

// `box {}` takes its size, and a mesh its scale, from the fields of the object.
Value with_size(Value shape, const Value& fields) {
  const Value& size = fields["size"];
  if (shape.items.empty() && size.present()) {
    shape.items = size.kind == Value::Kind::number ? std::vector<Value>{size} : size.items;
  }
  if (!shape["scale"].present() && fields["scale"].present()) shape.fields["scale"] = fields["scale"];
  return shape;
}

void append_shape(const Value& value, const Shape& common, const std::filesystem::path& folder,
                  std::vector<Shape>& shapes) {
  const auto [word, numbers] = shape_word(value);
  Shape shape = common;
  std::vector<std::vector<Vector3>> hulls;
  if (word == "box") {
    const Value& edges = (*numbers)["size"].present() ? (*numbers)["size"] : *numbers;
    for (int i = 0; i < 3; ++i) shape.size[i] = dimension(edges, value, static_cast<std::size_t>(i), "size");
  } else if (word == "hull") {
    hulls.push_back(points_from(*numbers));
  } else if (word == "lathe") {
    hulls = lathe_hulls(*numbers);
  } else if (word == "mesh") {
    hulls = mesh_hulls(*numbers, value, folder);
  } else {
    shape.kind = word == "sphere"     ? ShapeKind::sphere
                 : word == "cylinder" ? ShapeKind::cylinder
                 : word == "capsule"  ? ShapeKind::capsule
                                      : ShapeKind::cone;
    shape.radius = dimension(*numbers, value, 0, "radius");
    if (word != "sphere") shape.length = dimension(*numbers, value, 1, "length");
  }
  if (hulls.empty()) shapes.push_back(shape);
  for (std::vector<Vector3>& points : hulls) {
    shape.kind = ShapeKind::hull;
    shape.points = std::move(points);
    shapes.push_back(shape);
  }
}

}  // namespace

std::vector<Shape> shapes_from(const Value& fields, const Colours& colours, const Colour& own,
                               const std::filesystem::path& folder) {
  std::vector<const Value*> written;
  if (fields["shape"].present()) written.push_back(&fields["shape"]);
  for (const Value& item : fields["shapes"].items) written.push_back(&item);
  std::vector<Shape> shapes;
  for (const Value* shape : written) {
    const Value sized = with_size(*shape, fields);
    const Value* const value = &sized;
    Shape common;
    common.part_from_shape = transform_from(*value);
    common.colour = (*value)["colour"].present() ? colour_from((*value)["colour"], colours) : own;
    common.collides = value->boolean_or("collides", true);
    common.visible = value->boolean_or("visible", true);
    append_shape(*value, common, folder, shapes);
  }
  return shapes;
}

}  // namespace stampede
