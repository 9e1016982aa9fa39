// What an eye sees, pixel by pixel, before and after it has colours; and the corners of a thing in it.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/render/pixel_kernels.h"

namespace stampede {

// Shapes: height x width, rows from the top, and kLanes more that hold nothing.
struct PixelSurface {
  int width = 0, height = 0;
  std::vector<float> nearness;         // 1 / m
  std::vector<std::int32_t> triangle;  // kNoTriangle: background
  std::vector<std::uint32_t> colours;  // red in the lowest byte; empty: none

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  SurfaceView view() { return {width, height, nearness.data(), triangle.data(), colours.data()}; }
  // Nothing nearer than `far_m`, in the colour of the background.
  void clear(int wide, int high, double far_m, bool coloured, std::uint32_t background) {
    width = wide;
    height = high;
    nearness.assign(pixels() + kLanes, static_cast<float>(1 / far_m));
    triangle.assign(pixels() + kLanes, kNoTriangle);
    colours.assign(coloured ? pixels() + kLanes : 0, background);
  }
};

// Owns what CornersInEye are.
class CornerRoom {
 public:
  void resize(std::size_t corners) {
    for (auto& places : places_) places.resize(corners);
    for (auto& pixels : pixels_) pixels.resize(corners);
    view_ = {places_[0].data(), places_[1].data(), places_[2].data(),
             pixels_[0].data(), pixels_[1].data(), pixels_[2].data()};
  }
  const CornersInEye& view() const { return view_; }

 private:
  std::array<std::vector<float>, 3> places_;
  std::array<std::vector<std::int32_t>, 3> pixels_;
  CornersInEye view_;
};

}  // namespace stampede
