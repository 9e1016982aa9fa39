#include "engine/geometry/drawn_mesh.h"

#include <cstring>

#include "engine/base/error.h"

namespace stampede {
namespace {

static_assert(sizeof(float) == 4);

// Little-endian, as all processors are that this is built for.
template <typename Item>
void write(const std::vector<Item>& items, std::string& bytes) {
  const auto count = static_cast<std::uint32_t>(items.size());
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item));
}

[[noreturn]] void damaged() { throw Error("mesh", "its bytes are damaged", "generate the scene again"); }

template <typename Item>
void read(std::vector<Item>& items, std::string_view& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() < sizeof count) damaged();
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  if (bytes.size() / sizeof(Item) < count) damaged();
  items.resize(count);
  if (count > 0) std::memcpy(items.data(), bytes.data(), count * sizeof(Item));
  bytes.remove_prefix(count * sizeof(Item));
}

}  // namespace

std::string to_bytes(const DrawnMesh& mesh) {
  std::string bytes;
  write(mesh.positions, bytes);
  write(mesh.normals, bytes);
  write(mesh.coordinates, bytes);
  write(mesh.triangles, bytes);
  return bytes;
}

DrawnMesh mesh_from_bytes(std::string_view bytes) {
  DrawnMesh mesh;
  read(mesh.positions, bytes);
  read(mesh.normals, bytes);
  read(mesh.coordinates, bytes);
  read(mesh.triangles, bytes);
  const std::size_t count = mesh.positions.size();
  if (!bytes.empty() || mesh.normals.size() != count) damaged();
  if (!mesh.coordinates.empty() && mesh.coordinates.size() != count) damaged();
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= count) damaged();
  return mesh;
}

}  // namespace stampede
