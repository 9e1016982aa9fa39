// Whether what is drawn lies where a real picture shows it: offsets between the outline of a mask and the edges of the
// picture, as edge-based trackers measure them (Harris, Stennett, RAPiD, BMVC 1990, doi:10.5244/C.4.15).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stampede {

struct AlignmentOptions {
  double range_px = 12;    // searched on both sides of the outline
  double least_slope = 8;  // levels of colour a pixel: what is flatter is no edge
};

// A point of the outline, and where along the normal the picture's edge lies that is nearest of those at least half as
// steep as the steepest: positive outside.
struct OutlinePoint {
  std::array<double, 2> at{};      // px, centres of pixels at halves
  std::array<double, 2> normal{};  // unit, out of the mask
  bool found = false;              // an edge
  double offset = 0;               // px
};

// `mask`: nonzero where the thing is. Shapes: height x width, rgb with 3 a pixel. One point about every second pixel of
// the outline, none within `range_px` of the border of the picture. Repeatable.
std::vector<OutlinePoint> outline_offsets(std::span<const std::uint8_t> mask, std::span<const std::uint8_t> rgb,
                                          int width, int height, const AlignmentOptions& options = {});

struct Alignment {
  std::int64_t points = 0, found = 0;  // of the outline; with an edge
  double median_px = 0, p95_px = 0;    // of the absolute offsets; 0 where none was found
  double mean_px = 0;                  // likewise
  std::array<double, 2> shift_px{};    // that moves the drawing onto the picture, right and down
};

// Over the points of many pictures. The shift is the least-squares one, with outliers weighed down (Huber 1964,
// doi:10.1214/aoms/1177703732).
Alignment alignment_of(const std::vector<OutlinePoint>& points);

}  // namespace stampede
