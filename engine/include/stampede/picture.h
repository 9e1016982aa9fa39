// What cameras see, as plain arrays, and which of it an episode stores.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stampede {

enum class PicturesOf { none, keyframes, all };  // frames

// own: from the same scene the same pixels on every processor. osmesa: OpenGL by Mesa, a reference that nobody here
// wrote; its pixels are those of its version and of the class of processor.
enum class DrawnBy { own, osmesa };

// What `run` stores beside the episode.
struct PictureStorage {
  PicturesOf frames = PicturesOf::all;
  std::vector<std::string> cameras = {};  // empty: all of the world
  int width = 0, height = 0;              // pixels, at most 4096; 0: each camera's own
  bool rgb = true, depth = true, instance = true, semantic = true;
  bool points = false;
  bool shadows = false;
  double rgb_noise = 0;    // standard deviation of each channel, of 0 … 1
  double depth_noise = 0;  // 1/m: deviation depth_noise * z^2; 0.00145 is a Kinect's
  DrawnBy renderer = DrawnBy::own;
};

// One camera at one frame. What is false is not drawn.
struct PictureRequest {
  std::string camera = "front";
  int width = 0, height = 0;  // pixels, at most 4096; 0: the camera's own
  bool rgb = true, depth = false, instance = false, semantic = false;
  bool shadows = false;
};

// Shapes: height x width, rows from the top; what was not asked for is empty. Frames: the camera looks along its z, x
// is right and y down in the picture; a point of the camera's frame is at u = focal_x * x / z + centre_x from the left
// edge and v = focal_y * y / z + centre_y from the upper one.
struct CameraPicture {
  int width = 0, height = 0;            // pixels
  std::vector<std::uint8_t> rgb;        // 3 a pixel, sRGB
  std::vector<float> depth;             // m along z; 0: nothing between the near and the far plane
  std::vector<std::uint16_t> instance;  // column `instance` of view `masks`; 0: background
  std::vector<std::uint16_t> semantic;  // column `semantic` of view `masks`; 0: background
  double focal_x = 0, focal_y = 0, centre_x = 0, centre_y = 0;  // pixels
  std::array<double, 16> world_from_camera{};                   // 4 x 4, row by row, m
};

// The points that a camera sees, row by row of its picture. Shapes: one entry a point in each list. Units: m, world.
struct CameraPoints {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint8_t, 3>> colours;  // empty when rgb was not asked for
  std::vector<std::uint16_t> instance, semantic;     // likewise
};

}  // namespace stampede
