// A scene as triangles in the world, and which of them an eye can see. Knows nothing of OpenGL.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/model/scene.h"
#include "engine/model/scene_poses.h"

namespace stampede {

// What a corner keeps in all poses; one per corner of every visible shape, in the scene's order.
struct StillCorner {
  std::array<float, 3> coordinate;     // of the texture: on all three axes, in repeats; or its own (mesh)
  std::array<std::int8_t, 4> side;     // normal in the shape's frame, 127 for 1; w: 127 when it has its own coordinate
  std::array<std::uint8_t, 4> colour;  // sRGB and alpha
  std::uint32_t ids;                   // instance + 65536 * semantic
};

struct MovedCorner {
  std::array<float, 3> position, normal;  // world
};

// Triangles of one draw call: a range of the selected indices.
struct Batch {
  std::string texture;  // empty: plain
  bool two_sided = false, translucent = false;
  std::uint32_t first = 0, count = 0;
};

struct Selection {
  std::vector<std::uint32_t> indices;
  std::vector<Batch> batches;  // opaque ones in front
};

// Where things land in a picture: clip coordinates as OpenGL has them, depth reversed (1 near, 0 far, divided by w);
// rows from the top.
struct Eye {
  Eigen::Matrix4d clip_from_world = Eigen::Matrix4d::Identity();
  int width = 0, height = 0;
};

inline constexpr std::size_t kLanes = 8;  // floats that are computed together

// A shape's triangles, told apart by content: scenes of a task share most of them.
class TessellationCache {
 public:
  struct Entry {
    DrawnMesh mesh;
    std::array<std::vector<float>, 3> places;  // x, y, z of the mesh's corners, each padded to whole kLanes
    bool closed = true;
    Vector3 centre = Vector3::Zero();  // of a sphere around it
    double radius = 0;
  };
  std::shared_ptr<const Entry> get(const Shape& shape, const Scene& scene);

 private:
  std::map<std::string, std::shared_ptr<const Entry>> entries_;
  std::size_t corners_ = 0;
};

class SceneDrawing {
 public:
  // Throws Error for scenes without mask numbers, missing textures, and what tessellate refuses.
  SceneDrawing(const Scene& scene, TessellationCache& cache);

  void move(const ScenePoses& poses);  // throws Error when they are of another scene

  // The triangles that may touch a pixel's centre, nearest things first (the translucent ones: furthest first). Left
  // out is only what no rasteriser would draw: so pixels do not depend on it. `colours`: else nothing translucent.
  void select(const Eye& eye, bool colours, Selection& selection);

  struct Thing {
    int body = -1;  // of Scene::bodies; kRobot, kRegion
    int part = 0;   // or index of the region
    Transform part_from_shape = Transform::Identity();
    std::shared_ptr<const TessellationCache::Entry> entry;
    std::uint32_t first_corner = 0, first_index = 0, index_count = 0;
    bool two_sided = false, translucent = false;
    std::string texture;
    std::vector<std::string> shown_by;  // as Shape has it
    bool shown_without = false;
    bool shown = true;                       // as of the last move
    Vector3 world_centre = Vector3::Zero();  // as of the last move
  };
  const std::vector<Thing>& things() const { return things_; }
  Transform world_from_shape(const Thing& thing, const ScenePoses& poses) const;  // throws Error, as move does

  static bool shows(const Thing& thing, const ScenePoses& poses);

  const std::vector<StillCorner>& still() const { return still_; }
  const std::vector<MovedCorner>& moved() const { return moved_; }
  std::size_t triangles() const { return corners_of_triangles_.size() / 3; }

  // Centre and radius of each opaque thing, world.
  struct Ball {
    Vector3 centre;
    double radius;
  };
  std::vector<Ball> balls() const;

 private:
  // `thing`: of which body and part.
  void add(Thing thing, const Shape& shape, std::uint32_t ids, const Scene& scene, TessellationCache& cache);
  const Transform& pose_of(const Thing& thing, const ScenePoses& poses) const;
  void project(const Thing& thing, const Eigen::Matrix4f& clip_from_world, const Eye& eye);
  void take_triangles(const Thing& thing, const Eye& eye, std::vector<std::uint32_t>& indices) const;

  struct Projected {
    float x, y;          // pixels; meaningless where `place` is not 0
    std::int32_t place;  // bits: 1 nearer than near, 2 beyond far
  };
  std::vector<Thing> things_;
  std::vector<StillCorner> still_;
  std::vector<MovedCorner> moved_;
  std::vector<std::uint32_t> corners_of_triangles_;
  std::vector<Projected> projected_;
};

}  // namespace stampede
