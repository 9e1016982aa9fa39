#include "engine/model/telling.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace stampede {
namespace {

constexpr int kWhole = -1;
constexpr std::size_t kReach = 3;  // words from a colour to what has it: `blue and white mug`

// Words that say how something looks, whichever colours a library has.
const std::set<std::string>& look_words() {
  static const std::set<std::string> words{
      "red",    "green",   "blue",      "yellow",    "black",   "white",    "grey",    "gray",        "orange",
      "purple", "violet",  "cyan",      "magenta",   "pink",    "brown",    "navy",    "teal",        "olive",
      "maroon", "azure",   "lime",      "rose",      "silver",  "gold",     "golden",  "beige",       "turquoise",
      "ivory",  "crimson", "scarlet",   "tan",       "cream",   "copper",   "bronze",  "brass",       "indigo",
      "wooden", "wood",    "metal",     "metallic",  "steel",   "plastic",  "rubber",  "leather",     "marble",
      "dark",   "bright",  "pale",      "coloured",  "colored", "striped",  "spotted", "dotted",      "chequered",
      "shiny",  "glossy",  "checkered", "patterned", "matt",    "textured", "painted", "transparent", "rusty"};
  return words;
}

// `red_square12.lid` has the words red, square and lid.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

std::string own_name(const Object& object) { return object.name.substr(object.name.rfind('.') + 1); }

// The attributes that say where a part belongs are not of looks.
bool is_spoken_of(const Object& object) {
  return std::any_of(object.attributes.begin(), object.attributes.end(), [](const auto& attribute) {
    return attribute.first != "part_of" && attribute.first != "part_name";
  });
}

bool has_value(const Scene& scene, const std::string& value) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    return std::any_of(object.attributes.begin(), object.attributes.end(),
                       [&](const auto& attribute) { return attribute.second == value; });
  });
}

// `blocks` is what is called `block`, `ball` what is called `basketball`.
bool is_called(const Object& object, std::string word) {
  constexpr std::size_t kShortest = 3;
  if (word.size() > kShortest && word.back() == 's') word.pop_back();
  if (word.size() < kShortest) return false;
  for (const std::string& name : {own_name(object), object.class_name, object.type}) {
    const std::vector<std::string> words = words_of(name);
    if (!words.empty() && words.back().ends_with(word)) return true;
  }
  return false;
}

auto look_of(const Shape& shape) {
  const Colour& c = shape.colour;
  return std::tuple(shape.texture, c.red, c.green, c.blue, c.alpha);
}

bool look_alike(const Body& first, const Body& second) {
  if (first.parts.size() != second.parts.size()) return false;
  for (std::size_t i = 0; i < first.parts.size(); ++i)
    if (!std::equal(first.parts[i].shapes.begin(), first.parts[i].shapes.end(), second.parts[i].shapes.begin(),
                    second.parts[i].shapes.end(),
                    [](const Shape& a, const Shape& b) { return look_of(a) == look_of(b); }))
      return false;
  return true;
}

// Of the box around it, m^2.
double surface(const Scene& scene, const Shape& shape) {
  Vector3 size = Vector3::Zero();
  if (const auto mesh = scene.meshes.find(shape.mesh); shape.kind == ShapeKind::mesh && mesh != scene.meshes.end()) {
    Eigen::AlignedBox3f box;
    for (const auto& corner : mesh->second->positions) box.extend(Eigen::Vector3f(corner[0], corner[1], corner[2]));
    if (!box.isEmpty()) size = box.sizes().cast<double>();
  } else {
    Part alone;
    alone.shapes = {shape};
    const auto [lower, upper] = bounding_box(alone);
    size = upper - lower;
  }
  return 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}

bool is_picture(const Scene& scene, const Shape& shape) {
  const auto texture = scene.textures.find(shape.texture);
  return texture != scene.textures.end() && texture->second.kind == TextureKind::image;
}

// CIE L*a*b* of an sRGB colour, D65.
Vector3 lab(const Colour& colour) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const double r = linear(colour.red), g = linear(colour.green), b = linear(colour.blue);
  const auto root = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = root((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const double y = root(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double z = root((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

}  // namespace

double difference(const Colour& first, const Colour& second) { return (lab(first) - lab(second)).norm(); }

Telling::Telling(const Scene& scene, const std::vector<std::string>& said) : scene_(scene) {
  keep_named();
  keep_twins();
  for (const std::string& sentence : said) keep_spoken(sentence);
}

void Telling::keep(const Object& object) {
  if (object.kind == ObjectKind::body) kept_.emplace(object.body, kWhole);
  if (object.kind == ObjectKind::part) kept_.emplace(object.body, object.part);
  if (object.kind != ObjectKind::region) return;
  const int region = scene_.region_index(object.name);
  if (region < 0) return;
  const Region& place = scene_.regions[static_cast<std::size_t>(region)];
  kept_.emplace(place.body, place.part);
}

void Telling::keep_named() {
  for (const Object& object : scene_.objects) {
    std::vector<std::string> words = words_of(own_name(object));
    for (std::string& word : words_of(object.class_name)) words.push_back(std::move(word));
    if (is_spoken_of(object) ||
        std::any_of(words.begin(), words.end(), [](const std::string& word) { return look_words().contains(word); }))
      keep(object);
  }
}

// Movable things of one type and several kinds are known by their looks, as groceries are by their labels, and so are
// things of one kind that look different.
void Telling::keep_twins() {
  std::map<std::string, std::vector<const Object*>> by_type;
  for (const Object& object : scene_.objects)
    if (object.kind == ObjectKind::body && scene_.body_index(object.body) >= 0) by_type[object.type].push_back(&object);
  const auto differ = [&](const Object& a, const Object& b) {
    const Body &first = scene_.body_at(scene_.body_index(a.body)), &second = scene_.body_at(scene_.body_index(b.body));
    return a.class_name == b.class_name ? !look_alike(first, second) : first.free && second.free;
  };
  for (const auto& [type, things] : by_type)
    for (const Object* one : things)
      if (std::any_of(things.begin(), things.end(), [&](const Object* other) { return differ(*one, *other); }))
        keep(*one);
}

// What follows `red` within a few words keeps its look: things that are called so.
bool Telling::keep_followed(const std::vector<std::string>& words, std::size_t look) {
  for (std::size_t i = look + 1; i < words.size() && i <= look + kReach; ++i) {
    bool found = false;
    for (const Object& object : scene_.objects)
      if (object.kind != ObjectKind::hand && is_called(object, words[i])) keep(object), found = true;
    if (found) return true;
  }
  return false;
}

// Where nobody knows what a colour is said of, it may be anything that the task brings.
void Telling::keep_spoken(const std::string& sentence) {
  const std::vector<std::string> words = words_of(sentence);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!look_words().contains(words[i]) || keep_followed(words, i) || has_value(scene_, words[i])) continue;
    for (const Body& body : scene_.bodies)
      if (!body.fixture) kept_.emplace(body.name, kWhole);
  }
}

bool Telling::tells(const Body& body, std::size_t part) const {
  return kept_.contains({body.name, kWhole}) || kept_.contains({body.name, static_cast<int>(part)});
}

std::vector<std::size_t> Telling::ground(const Body& body, std::size_t part) const {
  if (tells(body, part)) return {};
  const std::vector<Shape>& shapes = body.parts[part].shapes;
  const bool marked = &body != &scene_.robot.body;
  std::map<decltype(look_of(shapes[0])), std::pair<double, std::vector<std::size_t>>> looks;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = shapes[i];
    if (!shape.visible || !shape.shown_by.empty() || (body.free && is_picture(scene_, shape))) continue;
    auto& [size, indices] = looks[marked ? look_of(shape) : decltype(look_of(shape))()];
    size += surface(scene_, shape);
    indices.push_back(i);
  }
  const auto widest = std::max_element(looks.begin(), looks.end(),
                                       [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
  return widest == looks.end() ? std::vector<std::size_t>() : widest->second.second;
}

std::vector<Colour> Telling::standing(const Body& body) const {
  std::vector<Colour> colours;
  const auto add = [&](const Shape& shape) {
    const auto texture = scene_.textures.find(shape.texture);
    const auto times = [&](const Colour& c) {
      colours.push_back({c.red * shape.colour.red, c.green * shape.colour.green, c.blue * shape.colour.blue, 1});
    };
    if (texture == scene_.textures.end()) return colours.push_back(shape.colour);
    if (texture->second.kind != TextureKind::image) times(texture->second.first), times(texture->second.second);
  };
  for (const Body& other : scene_.bodies)
    for (std::size_t i = 0; i < other.parts.size(); ++i) {
      const bool own = other.name == body.name;
      if (!own && !tells(other, i)) continue;
      const std::vector<std::size_t> drawn = ground(other, i);
      for (std::size_t k = 0; k < other.parts[i].shapes.size(); ++k)
        if (other.parts[i].shapes[k].visible && !std::binary_search(drawn.begin(), drawn.end(), k))
          add(other.parts[i].shapes[k]);
    }
  for (const Region& region : scene_.regions)
    if (region.visible) colours.push_back(region.colour);
  return colours;
}

}  // namespace stampede
