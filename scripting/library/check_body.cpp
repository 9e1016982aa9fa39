// What an object, a part, a region and an entry may all say of a body.
#include <algorithm>
#include <optional>

#include "scripting/library/checks.h"
#include "scripting/library/scene_outline.h"

namespace stampede {
namespace {

constexpr double kOpening = 0.08;  // m, of a robot that says nothing else

struct Range {
  double lower, upper;
  bool contains(double position) const { return !(position < lower || position > upper); }
};

std::optional<Range> range_of(const Value& joint) {
  const std::vector<Value>& range = joint["range"].items;
  if (range.size() != 2 || !range[0].is_number() || !range[1].is_number()) return std::nullopt;
  return Range{range[0].number, range[1].number};
}

class BodyCheck {
 public:
  BodyCheck(LibraryDraft& draft, const Definition& definition, const Value& body, const std::string& path)
      : draft_(draft), definition_(definition), body_(body), prefix_(path.empty() ? "" : path + ".") {}

  void check() {
    check_type();
    check_tables();
    draft_.numbers().check_values(body_["numbers"], prefix_ + "numbers.", definition_.complainer());
    refuse_negative(body_, prefix_, {"mass", "friction", "restitution"});
    for (const char* kind : kMovingJoints) check_joint(body_[kind], prefix_ + kind);
    if (body_["shape"].is_table()) check_shape(body_["shape"]);
    for (const Value& shape : body_["shapes"].items) check_shape(shape);
    check_grasps();
    check_colour();
  }

 private:
  void complain(const std::string& path, const std::string& what, const std::string& hint = {}) const {
    definition_.complain(path, what, hint);
  }

  void check_type() {
    const Domain& domain = draft_.vocabulary().domain;
    const Value& type = body_["type"];
    if (type.is_text() && !domain.types.contains(type.text))
      definition_.complain_unknown(prefix_ + "type", "type", type.text, keys_of(domain.types));
    for (const std::string& trait : texts_of(body_["traits"]))
      if (!listed(domain.traits, trait))
        definition_.complain_unknown(prefix_ + "traits", "trait", trait, domain.traits);
  }

  void check_tables() {
    for (const auto& [table, wanted] : {std::pair{"numbers", "number"}, {"attributes", "string|number|boolean"}}) {
      for (const auto& [name, value] : body_[table].fields) {
        const std::string where = prefix_ + table + "." + name;
        check_name(name, where, definition_.complainer());
        if (!has_type(value, wanted)) complain(where, "this is " + value.type_name());
      }
    }
  }

  void refuse_negative(const Value& node, const std::string& prefix, std::initializer_list<const char*> fields) {
    for (const char* field : fields)
      if (node[field].is_number() && node[field].number < 0) complain(prefix + field, "is negative");
  }

  void check_joint(const Value& joint, const std::string& where) {
    if (!joint.present()) return;
    if (const auto range = range_of(joint)) {
      const Value& initial = joint["initial"];
      const bool known = initial.is_number() || !initial.present();
      if (range->lower >= range->upper) complain(where + ".range", "ends before it begins", "range = { lower, upper }");
      if (range->lower < range->upper && known && !range->contains(initial.plain_number(0)))
        complain(where + ".initial", "the position at the start is outside range", "move one of them");
    }
    refuse_negative(joint, where + ".", {"damping", "friction", "spring", "detent"});
    check_thread(joint, where);
    if (joint["lets_go"].present()) check_lets_go(joint, where);
  }

  void check_thread(const Value& joint, const std::string& where) {
    const bool screw = where.ends_with("screw");
    const Value& pitch = joint["pitch"];
    if (screw && (!pitch.present() || (pitch.is_number() && pitch.number == 0)))
      complain(where, "a screw without pitch does not travel",
               "pitch = mm(4): metres along the axis in a whole turn; one that only turns is a hinge");
    if (!screw && pitch.present()) complain(where + ".pitch", "only a screw has a pitch", "write screw = { … }");
  }

  void check_lets_go(const Value& joint, const std::string& where) {
    const Value& lets_go = joint["lets_go"];
    const auto range = range_of(joint);
    const double initial = joint["initial"].plain_number(0);
    if (lets_go.is_number() && range && (!range->contains(lets_go.number) || lets_go.number == initial))
      complain(where + ".lets_go", "the joint never gets there", "a position within range that is not the first");
    for (const char* other : {"damping", "spring", "stiffness", "detent", "latch", "follows"})
      if (joint[other].present())
        complain(where + "." + other, "a joint that lets go of its part has friction alone",
                 "leave it out, or leave out lets_go");
  }

  void check_shape(const Value& shape) {
    const std::string& kind = shape["shape"].text;
    if (!listed({"box", "sphere", "cylinder", "capsule", "cone"}, kind)) return;
    for (const Value& length : shape.items)
      if (length.is_number() && length.number <= 0)
        draft_.complaints().add(Error(place_in(*definition_.file, shape.line()),
                                      "a " + kind + " has an edge of " + plain_text(length),
                                      "lengths are positive, in metres"));
  }

  // Those that no hand can make.
  void check_grasps() {
    double widest = 0;
    for (const auto& [name, robot] : draft_.of(DefinitionKind::robot))
      widest = std::max(widest, robot.node["opening"].plain_number(kOpening));
    for (std::size_t i = 0; widest > 0 && i < body_["grasps"].items.size(); ++i) {
      const Value& width = body_["grasps"].items[i]["width"];
      if (width.is_number() && width.number > widest)
        complain(prefix_ + "grasps",
                 "grasp " + std::to_string(i + 1) + " is " + plain_text(width) +
                     " m wide, no hand opens further than " + std::to_string(widest).substr(0, 5) + " m",
                 "grasp it where it is narrower");
    }
  }

  void check_colour() {
    const Value& colour = body_["colour"];
    const Definition* colours = draft_.find(DefinitionKind::colours, "colours");
    if (!colour.is_text() || colours == nullptr || colours->node[colour.text].present()) return;
    definition_.complain_unknown(prefix_ + "colour", "colour", colour.text, keys_of(colours->node.fields));
  }

  LibraryDraft& draft_;
  const Definition& definition_;
  const Value& body_;
  const std::string prefix_;
};

}  // namespace

void check_body(LibraryDraft& draft, const Definition& definition, const Value& body, const std::string& path) {
  BodyCheck(draft, definition, body, path).check();
}

// Whether it lies on its tool is known when that is built.
void check_tip(const Definition& definition, const Value& node, const std::string& path) {
  if (!node["tip"].present()) return;
  const std::string where = path.empty() ? "tip" : path + ".tip";
  if (node["region"].present())
    return definition.complain(where, "a region has no tip", "give it to an object with shapes");
  if (node["regions"]["tip"].present())
    definition.complain(where, "there is a region 'tip' too, and both are called OBJECT.tip", "rename the region");
  if (node["parts"]["tip"].present())
    definition.complain(where, "there is a part 'tip' too, and both are called OBJECT.tip", "rename the part");
}

}  // namespace stampede
