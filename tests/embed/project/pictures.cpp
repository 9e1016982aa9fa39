// What cameras see, as plain arrays: checked against each other, with the public headers alone.
#include <cmath>
#include <cstdio>
#include <stampede/session.h>

int main() {
  stampede::Session session({.catalogue = "pictures.db"});
  const stampede::PictureStorage storage = {.frames = stampede::PicturesOf::keyframes, .cameras = {"front"}};
  const stampede::Episode e = session.run("reach_target", {.seed = 7, .pictures = storage});
  const stampede::PictureRequest request = {
      .camera = "front", .width = 160, .height = 120, .depth = true, .instance = true};
  const stampede::CameraPicture picture = session.picture(e.id, e.frames - 1, request);
  const stampede::CameraPoints points = session.points(e.id, e.frames - 1, request);

  // Each pixel with a depth, taken into the world by hand, is the next point of the cloud.
  std::size_t next = 0;
  double worst = 0;
  for (int v = 0; v < picture.height; ++v)
    for (int u = 0; u < picture.width; ++u) {
      const double z = picture.depth[static_cast<std::size_t>(v * picture.width + u)];
      if (z == 0) continue;
      const double x = (u + 0.5 - picture.centre_x) / picture.focal_x * z;
      const double y = (v + 0.5 - picture.centre_y) / picture.focal_y * z;
      if (next == points.positions.size()) return 1;
      for (std::size_t row = 0; row < 3; ++row) {
        const double* m = &picture.world_from_camera[4 * row];
        worst = std::fmax(worst, std::fabs(m[0] * x + m[1] * y + m[2] * z + m[3] - points.positions[next][row]));
      }
      ++next;
    }
  const auto stored = session.query("SELECT count(*) AS n FROM images WHERE camera = 'front'").integer(0, "n");
  std::printf("%zu points, %.6f m, %d pictures\n", next, worst, static_cast<int>(stored));
  return next == points.positions.size() && next > 1000 && worst < 1e-5 && stored > 0 ? 0 : 2;
}
