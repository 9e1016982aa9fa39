#include "db/camera_writer.h"

#include "db/catalogue_impl.h"
#include "db/insert.h"
#include "engine/model/camera.h"

namespace stampede {
namespace {

// Of (episode, body, part). An object's parts have objects, by which they are named; those of the robot, which is no
// object, have the first mask numbers, in order.
constexpr const char* kMountLink =
    "SELECT name FROM object WHERE episode = ?1 AND body = ?2 AND part = ?3 AND kind IN ('body', 'part') UNION ALL "
    "SELECT name FROM mask WHERE episode = ?1 AND instance = ?3 + 1 AND substr(name, 1, length(?2) + 1) = ?2 || '.' "
    "AND NOT EXISTS (SELECT 1 FROM object WHERE episode = ?1 AND body = ?2 AND kind = 'body')";

}  // namespace

CameraWriter::CameraWriter(const sql::Database& database)
    : camera_(insert(database, "camera",
                     "episode, ordinal, name, width, height, focal_x, focal_y, centre_x, centre_y, k1, k2, p1, p2, "
                     "k3, near_m, far_m, mount_body, mount_part, mount_link, vertical_fov_rad, mount_matrix, x, y, z, "
                     "qx, qy, qz, qw")),
      camera_pose_(insert(database, "camera_pose", "episode, camera, frame, x, y, z, qx, qy, qz, qw")),
      mount_link_(database, kMountLink, true) {}

// The body's name where its part has none.
std::string CameraWriter::mount_link(std::int64_t episode, const Camera& camera) {
  if (camera.mount_body.empty()) return "world";
  std::string link = camera.mount_body;
  if (mount_link_.start(episode, camera.mount_body, camera.mount_part).step()) mount_link_.read(link);
  sqlite3_reset(mount_link_.handle());
  return link;
}

void CameraWriter::write(std::int64_t episode, int ordinal, const Camera& c) {
  const auto& [k1, k2, p1, p2, k3] = c.distortion;
  const std::string link = mount_link(episode, c), matrix = matrix_text(c.mount_from_camera);
  camera_.run(episode, ordinal, c.name, c.width, c.height, c.focal_x, c.focal_y, c.centre_x, c.centre_y, k1, k2, p1, p2,
              k3, c.near_m, c.far_m, c.mount_body, c.mount_part, link, vertical_field_of_view(c), matrix,
              to_pose(c.mount_from_camera));
}

void CameraWriter::write_poses(std::int64_t episode, int camera, std::size_t frames,
                               const std::function<const Pose*(std::size_t)>& pose_at) {
  const Pose* last = nullptr;
  for (std::size_t i = 0; i < frames; ++i) {
    const Pose* pose = pose_at(i);
    if (pose == nullptr || (last != nullptr && *last == *pose)) continue;
    camera_pose_.run(episode, camera, i, *pose);
    last = pose;
  }
}

}  // namespace stampede
