#include "engine/geometry/mesh_form.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include "engine/base/error.h"
#include "engine/geometry/import.h"

namespace stampede {
namespace fs = std::filesystem;
namespace {

constexpr int kMostCorners = 4096;  // of a face

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw Error(file.string(), "not a sound mesh: " + what, kMeshCure);
}

template <typename Number>
Number number_at(std::string_view bytes, std::size_t at, bool big) {
  std::array<char, sizeof(Number)> raw{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), raw.size(), raw.begin());
  if (big) std::reverse(raw.begin(), raw.end());
  Number number{};
  std::memcpy(&number, raw.data(), raw.size());
  return number;
}

void check_stl(const fs::path& file, std::string_view bytes) {
  if (bytes.starts_with("solid") && bytes.substr(0, 4096).find("facet") != std::string_view::npos) return;
  if (bytes.size() < 84) refuse(file, "a binary STL has at least 84 bytes, this has " + std::to_string(bytes.size()));
  const auto count = number_at<std::uint32_t>(bytes, 80, false);
  const std::size_t room = (bytes.size() - 84) / 50;
  if (count > room)
    refuse(file,
           "it says that it has " + std::to_string(count) + " triangles, and has bytes for " + std::to_string(room));
}

void check_glb(const fs::path& file, std::string_view bytes) {
  if (bytes.size() < 20 || !bytes.starts_with("glTF"))
    throw Error(file.string(), "not a readable mesh: it does not begin as a GLB", kMeshCure);
  const auto length = number_at<std::uint32_t>(bytes, 8, false);
  const auto json = number_at<std::uint32_t>(bytes, 12, false);
  if (length > bytes.size() || json > bytes.size() - 20)
    refuse(file, "it says that it has " + std::to_string(std::max(length, json)) + " bytes, and has " +
                     std::to_string(bytes.size()));
}

void check_dae(const fs::path& file, std::string_view text) {
  if (text.find("<!ENTITY") != std::string_view::npos) refuse(file, "it declares entities");
  int depth = 0;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = std::min(text.find("-->", at), text.size() - 1);
      continue;
    }
    const char next = at + 1 < text.size() ? text[at + 1] : '\0';
    const std::size_t end = text.find('>', at);
    if (next == '/') --depth;
    if (std::isalpha(static_cast<unsigned char>(next)) == 0 || end == std::string_view::npos) continue;
    if (text[end - 1] != '/' && ++depth > kDeepestElement)
      refuse(file, "its elements are nested deeper than " + std::to_string(kDeepestElement));
  }
}

// A PLY, walked from its header to its last number.
class Ply {
 public:
  Ply(const fs::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  void check() {
    read_header();
    for (const Element& element : elements_)
      for (std::uint64_t row = 0; row < element.count; ++row)
        for (const Property& property : element.properties) read_property(element, property, row);
  }

 private:
  struct Property {
    std::string name;
    std::size_t size = 0;  // bytes of a value
    bool real = false, wide = false, is_signed = false;
    std::size_t list = 0;  // bytes of the count; 0: one value
    bool list_signed = false;
  };
  struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
  };

  std::string line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos || end - at_ > 4096) refuse(file_, "its header has no end");
    std::string text(bytes_.substr(at_, end - at_));
    if (!text.empty() && text.back() == '\r') text.pop_back();
    at_ = end + 1;
    return text;
  }

  [[noreturn]] void strange(const std::string& text) const {
    std::string shown = text.substr(0, 60);
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
    refuse(file_, "its header has the line '" + shown + "'");
  }

  void read_header() {
    if (line() != "ply") refuse(file_, "it does not begin as a PLY");
    for (std::string text = line(); text != "end_header"; text = line()) {
      std::istringstream words(text);
      std::string word;
      words >> word;
      if (word == "comment" || word == "obj_info" || word.empty()) continue;
      if (word == "format")
        read_format(words, text);
      else if (word == "element")
        read_element(words, text);
      else if (word == "property" && !elements_.empty())
        elements_.back().properties.push_back(property_of(words, text));
      else
        strange(text);
    }
    if (!formatted_) refuse(file_, "its header names no format");
  }

  void read_format(std::istringstream& words, const std::string& text) {
    std::string kind;
    words >> kind;
    formatted_ = true;
    text_ = kind == "ascii";
    big_ = kind == "binary_big_endian";
    if (!text_ && !big_ && kind != "binary_little_endian") strange(text);
  }

  void read_element(std::istringstream& words, const std::string& text) {
    Element element;
    std::string count;
    words >> element.name >> count;
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || end != count.data() + count.size()) strange(text);
    if (element.count > bytes_.size())  // each has a byte at least
      refuse(file_, "it says that it has " + count + " of '" + element.name + "', and has " +
                        std::to_string(bytes_.size()) + " bytes");
    if (element.name == "vertex") vertices_ = element.count;
    elements_.push_back(std::move(element));
  }

  Property property_of(std::istringstream& words, const std::string& text) const {
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      Property count;
      words >> type;
      if (!set_type(type, count) || count.real) strange(text);
      property.list = count.size;
      property.list_signed = count.is_signed;
      words >> type;
    }
    if (!set_type(type, property)) strange(text);
    words >> property.name;
    return property;
  }

  static bool set_type(const std::string& type, Property& property) {
    struct Type {
      std::size_t size;
      std::array<const char*, 2> names;
      bool real, is_signed;
    };
    static constexpr std::array kTypes{
        Type{1, {"char", "int8"}, false, true},    Type{1, {"uchar", "uint8"}, false, false},
        Type{2, {"short", "int16"}, false, true},  Type{2, {"ushort", "uint16"}, false, false},
        Type{4, {"int", "int32"}, false, true},    Type{4, {"uint", "uint32"}, false, false},
        Type{4, {"float", "float32"}, true, true}, Type{8, {"double", "float64"}, true, true}};
    for (const Type& one : kTypes) {
      if (type != one.names[0] && type != one.names[1]) continue;
      property.size = one.size, property.real = one.real, property.is_signed = one.is_signed;
      return true;
    }
    return false;
  }

  [[noreturn]] void ends() const { refuse(file_, "it ends before the last of what its header counts"); }

  double text_value() {
    while (at_ < bytes_.size() && std::isspace(static_cast<unsigned char>(bytes_[at_])) != 0) ++at_;
    if (at_ == bytes_.size()) ends();
    const char* const first = bytes_.data() + at_ + (bytes_[at_] == '+' ? 1 : 0);
    const char* const last = bytes_.data() + bytes_.size();
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error == std::errc::invalid_argument || (end != last && std::isspace(static_cast<unsigned char>(*end)) == 0))
      refuse(file_, "where a number should be, " + std::to_string(at_) + " bytes from its start, there is none");
    at_ = static_cast<std::size_t>(end - bytes_.data());
    return value;
  }

  double binary_value(std::size_t size, bool real, bool is_signed) {
    if (bytes_.size() - at_ < size) ends();
    const std::size_t at = at_;
    at_ += size;
    if (real) return size == 4 ? double{number_at<float>(bytes_, at, big_)} : number_at<double>(bytes_, at, big_);
    if (size == 1)
      return is_signed ? number_at<std::int8_t>(bytes_, at, big_) : number_at<std::uint8_t>(bytes_, at, big_);
    if (size == 2)
      return is_signed ? number_at<std::int16_t>(bytes_, at, big_) : number_at<std::uint16_t>(bytes_, at, big_);
    return is_signed ? number_at<std::int32_t>(bytes_, at, big_) : number_at<std::uint32_t>(bytes_, at, big_);
  }

  void read_property(const Element& element, const Property& property, std::uint64_t row) {
    const auto next = [&] {
      return text_ ? text_value() : binary_value(property.size, property.real, property.is_signed);
    };
    if (property.list == 0) {
      const double value = next();
      if (property.real && element.name == "vertex" && !std::isfinite(value))
        refuse(file_, "vertex " + std::to_string(row) + " has a " + property.name + " that is not a finite number");
      return;
    }
    const double count = text_ ? text_value() : binary_value(property.list, false, property.list_signed);
    const std::string where = element.name + " " + std::to_string(row);
    const double most = element.name == "face" ? kMostCorners : static_cast<double>(bytes_.size());
    if (!(count >= 0) || count > most || count != std::floor(count))
      refuse(file_, where + " has a list of a length that cannot be; at most " + std::to_string(std::lround(most)));
    const bool corners =
        element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index");
    for (double i = 0; i < count; ++i) {
      const double value = next();
      if (corners && !(value >= 0 && value < static_cast<double>(vertices_)))
        refuse(file_, where + " names a corner that is not there; there are " + std::to_string(vertices_));
    }
  }

  const fs::path& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool text_ = false, big_ = false, formatted_ = false;
  std::uint64_t vertices_ = 0;
  std::vector<Element> elements_;
};

}  // namespace

const std::vector<std::string>& mesh_endings() {
  static const std::vector<std::string> endings = {".obj", ".stl", ".dae", ".ply", ".gltf", ".glb"};
  return endings;
}

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

void check_form(const fs::path& file) {
  const std::string ending = ending_of(file);
  const std::vector<std::string>& known = mesh_endings();
  if (std::find(known.begin(), known.end(), ending) == known.end()) {
    std::string all;
    for (const std::string& one : known) all += (all.empty() ? "" : " ") + one;
    throw Error(file.string(), "mesh files that end in '" + ending + "' are not read; these are: " + all, kMeshCure);
  }
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.empty()) throw Error(file.string(), "not a readable mesh: it is empty", kMeshCure);
  if (ending == ".stl") check_stl(file, bytes);
  if (ending == ".glb") check_glb(file, bytes);
  if (ending == ".dae") check_dae(file, bytes);
  if (ending == ".ply") Ply(file, bytes).check();
}

}  // namespace stampede
