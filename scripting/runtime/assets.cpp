#include "scripting/runtime/assets.h"

#include <algorithm>
#include <cstdio>

#include "engine/base/error.h"
#include "engine/geometry/mesh.h"
#include "scripting/library/library.h"

namespace stampede {
namespace {

std::string key_of(const std::filesystem::path& file, const Vector3& scale) {
  char text[96];
  std::snprintf(text, sizeof text, "\n%a %a %a", scale.x(), scale.y(), scale.z());
  return file.string() + text;
}

// What `read` gives, kept under `key`; an error of the file is one of the author's place too.
template <typename Key, typename Kept, typename Read>
const Kept& kept(std::map<Key, Kept>& map, const Key& key, const Value& where, const Read& read) {
  auto found = map.find(key);
  if (found != map.end()) return found->second;
  try {
    return map.emplace(key, read()).first->second;
  } catch (const Error& error) {
    throw Error(where.place, (error.where().empty() ? "" : error.where() + ": ") + error.message(), error.hint());
  }
}

}  // namespace

const Assets::Drawn& Assets::drawn(const std::filesystem::path& file, const Vector3& scale, const Value& where) {
  return kept(drawn_, key_of(file, scale), where, [&] {
    Drawn drawn;
    if (const std::string text = mesh_remark(file); !text.empty()) remark({file.string(), text, kUpAxisCure});
    drawn.pieces = add_drawn(drawn.assets, file.filename().string(), load_drawn(file, scale, scope_));
    return drawn;
  });
}

const Assets::Hulls& Assets::hulls(const std::filesystem::path& file, const Vector3& scale, const Value& where) {
  return kept(hulls_, key_of(file, scale), where, [&] {
    if (const std::string text = mesh_remark(file); !text.empty()) remark({file.string(), text, kUpAxisCure});
    return load_hulls(file, scale, kHullPoints, scope_);
  });
}

std::shared_ptr<const Image> Assets::image(const std::filesystem::path& file, const Value& where) {
  return kept(images_, file, where, [&] {
    scope_.check(file);
    return std::make_shared<const Image>(load_image(file));
  });
}

const UrdfBody& Assets::urdf(const std::filesystem::path& file, bool free) {
  if (const auto found = urdfs_.find({file, free}); found != urdfs_.end()) return found->second;
  const UrdfBody& read = urdfs_.emplace(std::pair(file, free), read_urdf(file, scope_, free)).first->second;
  for (const Error& one : read.remarks) remark(one);
  return read;
}

void Assets::remark(const Error& remark) {
  const auto same = [&](const Error& other) { return std::string_view(other.what()) == remark.what(); };
  if (std::none_of(remarks_.begin(), remarks_.end(), same)) remarks_.push_back(remark);
}

std::shared_ptr<Assets> assets_of(const Library& library, std::shared_ptr<Assets> given) {
  return given ? std::move(given) : std::make_shared<Assets>(FileScope(library.roots().folders));
}

}  // namespace stampede
