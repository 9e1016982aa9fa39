#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scripting/library/rates.h"
#include "scripting/runtime/body_builder.h"
#include "scripting/runtime/evaluate.h"

namespace stampede {
namespace {

constexpr int kDrawnSides = 48;  // of a lathe: round at any distance a camera has

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
  if (rings.size() < 2 || rings.size() > kMostRings)
    list.expected("a profile of 2 to " + std::to_string(kMostRings) + " { radius, z }");
  return rings;
}

// The outline of the same, for drawing: outwards up and, where it is hollow, inwards down again.
std::vector<std::array<double, 2>> lathe_profile(const Value& list) {
  const std::vector<Ring> rings = rings_from(list);
  std::vector<std::array<double, 2>> profile;
  for (const Ring& ring : rings) profile.push_back({ring.outer, ring.z});
  if (!(list.number_or("wall", 0) > 0)) return profile;
  for (auto ring = rings.rbegin(); ring != rings.rend(); ++ring) profile.push_back({ring->inner, ring->z});
  profile.push_back(profile.front());
  return profile;
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

// The file and the scale of mesh { "file", scale = … }.
std::pair<std::filesystem::path, Vector3> mesh_file(const Value& numbers, const Value& whole,
                                                    const std::filesystem::path& folder) {
  const Value& named = numbers.kind == Value::Kind::text ? numbers
                       : !numbers.items.empty()          ? numbers.items[0]
                                                         : numbers["file"];
  const Value& scale = numbers["scale"].present() ? numbers["scale"] : whole["scale"];
  const Vector3 factor = !scale.present()                    ? Vector3(Vector3::Ones())
                         : scale.kind == Value::Kind::number ? Vector3(Vector3::Constant(scale.number))
                                                             : scale.as_vector();
  return {folder / named.as_text(), factor};
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

// A shape as it is written: what collides and what is drawn of it.
class ShapeReader {
 public:
  ShapeReader(const Value& value, const std::optional<Looks>& looks, const ShapeContext& context, bool drawn_only)
      : value_(value), looks_(looks), context_(context), drawn_only_(drawn_only) {
    common_.part_from_shape = transform_from(value);
    const Looks seen = looks.value_or(Looks{});
    common_.colour = seen.colour;
    common_.texture = seen.texture;
    common_.collides = !drawn_only && value.boolean_or("collides", true);
    common_.visible = value.boolean_or("visible", true);
    const Value& shows = value["shows"];
    if (!shows.present()) return;
    common_.shown_by = {shows["predicate"].text};
    common_.shown_without = shows["negated"].boolean;
    for (const Value& name : shows.items)
      common_.shown_by.push_back(name.text == "self" ? context.owner : context.owner + "." + name.text);
  }

  void append(std::vector<Shape>& shapes, bool hidden) {
    if (hidden) common_.visible = false;
    const auto [word, numbers] = shape_word(value_);
    if (word == "lathe" || word == "mesh") {
      if (!drawn_only_) append_hulls(word, *numbers, shapes);
      if (common_.visible) append_drawn(word, *numbers, shapes);
      return;
    }
    Shape shape = common_;
    if (word == "box") {
      const Value& edges = (*numbers)["size"].present() ? (*numbers)["size"] : *numbers;
      for (int i = 0; i < 3; ++i) shape.size[i] = dimension(edges, value_, static_cast<std::size_t>(i), "size");
    } else if (word == "hull") {
      shape.kind = ShapeKind::hull;
      shape.points = points_from(*numbers);
    } else {
      shape.kind = word == "sphere"     ? ShapeKind::sphere
                   : word == "cylinder" ? ShapeKind::cylinder
                   : word == "capsule"  ? ShapeKind::capsule
                                        : ShapeKind::cone;
      shape.radius = dimension(*numbers, value_, 0, "radius");
      if (word != "sphere") shape.length = dimension(*numbers, value_, 1, "length");
    }
    shapes.push_back(std::move(shape));
  }

 private:
  // Collide for what is drawn; never seen.
  void append_hulls(const std::string& word, const Value& numbers, std::vector<Shape>& shapes) {
    Shape shape = common_;
    shape.kind = ShapeKind::hull;
    shape.visible = false;
    shape.texture.clear();
    const auto [file, scale] =
        word == "mesh" ? mesh_file(numbers, value_, context_.folder) : std::pair<std::filesystem::path, Vector3>{};
    for (std::vector<Vector3> points :
         word == "mesh" ? context_.assets.hulls(file, scale, value_) : lathe_hulls(numbers)) {
      shape.points = std::move(points);
      shapes.push_back(shape);
    }
  }

  void append_drawn(const std::string& word, const Value& numbers, std::vector<Shape>& shapes) {
    std::vector<DrawnPiece> pieces;
    if (word == "mesh") {
      const auto [file, scale] = mesh_file(numbers, value_, context_.folder);
      const Assets::Drawn& drawn = context_.assets.drawn(file, scale, value_);
      context_.drawn.join(drawn.assets);
      pieces = drawn.pieces;
    } else {
      try {
        const DrawnMesh mesh = lathe_mesh(lathe_profile(numbers), kDrawnSides);
        pieces.push_back({context_.drawn.add(std::make_shared<const DrawnMesh>(mesh)), {}, {}});
      } catch (const Error& error) {
        throw Error(value_.place, error.message(), error.hint());
      }
    }
    for (Shape& shape : drawn_shapes(pieces, common_, looks_)) shapes.push_back(std::move(shape));
  }

  const Value& value_;
  const std::optional<Looks>& looks_;
  const ShapeContext& context_;
  bool drawn_only_;
  Shape common_;
};

// One shape, or a list of them.
std::vector<const Value*> written_shapes(const Value& value) {
  std::vector<const Value*> written;
  if (!value.present()) return written;
  if (value.fields.empty()) {
    for (const Value& item : value.items) written.push_back(&item);
  } else {
    written.push_back(&value);
  }
  return written;
}

double size_of(const Value& texture) {
  const double size = texture.number_or("size", Texture{}.size_m);
  if (!(size > 0)) texture["size"].expected("a size above 0");
  return size;
}

}  // namespace

std::string texture_from(const Value& value, const ShapeContext& context) {
  if (value.tag() != "texture") value.expected("a texture such as checker { \"white\", \"black\", size = 0.1 }");
  const std::string word = value["texture"].as_text();
  Texture texture;
  texture.size_m = size_of(value);
  texture.seed = static_cast<int>(value.number_or("seed", 0));
  if (word == "image") {
    if (value.items.size() != 1) value.expected("a file: texture { \"wood.png\", size = 0.2 }");
    const std::filesystem::path file = context.folder / value.items[0].as_text();
    texture.image = context.assets.image(file, value);
    return context.drawn.add(file.filename().string(), texture);
  }
  texture.kind = word == "checker"   ? TextureKind::checker
                 : word == "stripes" ? TextureKind::stripes
                                     : TextureKind::noise;
  if (value.items.size() > 2) value.expected("at most two colours");
  if (!value.items.empty()) texture.first = colour_from(value.items[0], context.colours);
  if (value.items.size() > 1) texture.second = colour_from(value.items[1], context.colours);
  return context.drawn.add(word, texture);
}

std::optional<Looks> looks_from(const Value& fields, const std::optional<Looks>& outer, const ShapeContext& context) {
  const Value &colour = fields["colour"], &texture = fields["texture"];
  if (!colour.present() && !texture.present()) return outer;
  Looks looks;
  if (texture.present()) {
    looks.texture = texture_from(texture, context);
    looks.colour = {1, 1, 1, 1};
  }
  if (colour.present()) looks.colour = colour_from(colour, context.colours);
  return looks;
}

std::vector<Shape> shapes_from(const Value& fields, const std::optional<Looks>& own, const ShapeContext& context) {
  std::vector<const Value*> written;
  if (fields["shape"].present()) written.push_back(&fields["shape"]);
  for (const Value& item : fields["shapes"].items) written.push_back(&item);
  const std::vector<const Value*> visual = written_shapes(fields["visual"]);
  std::vector<Shape> shapes;
  const auto append = [&](const Value* shape, bool drawn_only) {
    const Value sized = with_size(*shape, fields);
    const std::optional<Looks> looks = looks_from(sized, own, context);
    ShapeReader(sized, looks, context, drawn_only).append(shapes, !drawn_only && !visual.empty());
  };
  const auto checked = [&](const Value* shape) {
    if (shapes.size() > kMostShapes)
      throw Error(shape->place, "a body of more than " + std::to_string(kMostShapes) + " shapes",
                  "join them; a hollow lathe has one for each segment of each ring");
  };
  for (const Value* shape : written) append(shape, false), checked(shape);
  for (const Value* shape : visual) append(shape, true), checked(shape);
  return shapes;
}

}  // namespace stampede
