#include "engine/render/edge_alignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace stampede {
namespace {

constexpr double kStep = 0.25;    // px along a normal
constexpr double kAsSteep = 0.5;  // of the steepest: as good an edge
constexpr double kHuber = 0.75;   // px
constexpr int kRounds = 20;

// A picture of single values, smoothed by a Gaussian of about 1 px: (1 4 6 4 1) / 16 both ways.
class Smooth {
 public:
  Smooth(std::vector<float> values, int width, int height)
      : values_(std::move(values)), width_(width), height_(height) {
    along(1, width_, height_, width_);
    along(width_, height_, width_, 1);
  }
  // Bilinear; pixel centres at halves.
  double at(double x, double y) const {
    const double u = std::clamp(x - 0.5, 0.0, width_ - 1.001), v = std::clamp(y - 0.5, 0.0, height_ - 1.001);
    const auto i = static_cast<int>(u), j = static_cast<int>(v);
    const double a = u - i, b = v - j;
    const float* row =
        &values_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)];
    const float* below = row + width_;
    return (1 - b) * ((1 - a) * row[0] + a * row[1]) + b * ((1 - a) * below[0] + a * below[1]);
  }
  std::array<double, 2> slope(double x, double y) const {
    return {(at(x + 1, y) - at(x - 1, y)) / 2, (at(x, y + 1) - at(x, y - 1)) / 2};
  }

 private:
  void along(int stride, int length, int lines, int line_stride) {
    std::vector<float> line(static_cast<std::size_t>(length));
    for (int l = 0; l < lines; ++l) {
      float* first = &values_[static_cast<std::size_t>(l) * static_cast<std::size_t>(line_stride)];
      for (int i = 0; i < length; ++i)
        line[static_cast<std::size_t>(i)] = first[static_cast<std::ptrdiff_t>(i) * stride];
      const auto value = [&](int i) { return line[static_cast<std::size_t>(std::clamp(i, 0, length - 1))]; };
      for (int i = 0; i < length; ++i)
        first[static_cast<std::ptrdiff_t>(i) * stride] =
            (value(i - 2) + 4 * value(i - 1) + 6 * value(i) + 4 * value(i + 1) + value(i + 2)) / 16;
    }
  }
  std::vector<float> values_;
  int width_, height_;
};

// A colour picture: what is as bright as what lies behind it has an edge in its colour.
class SmoothColours {
 public:
  SmoothColours(std::span<const std::uint8_t> rgb, int width, int height) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<float> values(rgb.size() / 3);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = rgb[3 * i + c];
      channels_.emplace_back(std::move(values), width, height);
    }
  }
  // How much the colours of two places differ, levels: root mean square of the channels.
  double difference(const std::array<double, 2>& a, const std::array<double, 2>& b) const {
    double squares = 0;
    for (const Smooth& channel : channels_) {
      const double way = channel.at(a[0], a[1]) - channel.at(b[0], b[1]);
      squares += way * way;
    }
    return std::sqrt(squares / 3);
  }

 private:
  std::vector<Smooth> channels_;
};

// Along the normal the steepest place nearest to the outline of those that are about as steep as any: rims within the
// thing are often steeper than its outline. Between samples by a parabola.
void search(const SmoothColours& picture, const AlignmentOptions& options, OutlinePoint& point) {
  const int reach = static_cast<int>(options.range_px / kStep);
  std::vector<double> steepness;
  for (int i = -reach; i <= reach; ++i) {
    const double d = i * kStep;
    const auto place = [&](double along) {
      return std::array{point.at[0] + along * point.normal[0], point.at[1] + along * point.normal[1]};
    };
    steepness.push_back(picture.difference(place(d + 0.5), place(d - 0.5)));
  }
  const double steepest = *std::max_element(steepness.begin() + 1, steepness.end() - 1);
  const double enough = std::max(options.least_slope, kAsSteep * steepest);
  const auto outline = steepness.begin() + reach;
  auto best = steepness.end();
  for (auto at = steepness.begin() + 1; at != steepness.end() - 1; ++at) {
    if (*at < enough || *at < *(at - 1) || *at < *(at + 1)) continue;
    if (best == steepness.end() || std::abs(at - outline) < std::abs(best - outline)) best = at;
  }
  if (best == steepness.end()) return;
  const double curve = *(best - 1) - 2 * *best + *(best + 1);
  const double between = curve < 0 ? 0.5 * (*(best - 1) - *(best + 1)) / curve : 0;
  point.found = true;
  point.offset = (static_cast<double>(best - steepness.begin()) - reach + between) * kStep;
}

}  // namespace

std::vector<OutlinePoint> outline_offsets(std::span<const std::uint8_t> mask, std::span<const std::uint8_t> rgb,
                                          int width, int height, const AlignmentOptions& options) {
  std::vector<OutlinePoint> points;
  const int border = static_cast<int>(options.range_px) + 2;
  if (width <= 2 * border || height <= 2 * border) return points;
  std::vector<float> inside(mask.size());
  for (std::size_t i = 0; i < mask.size(); ++i) inside[i] = mask[i] != 0 ? 1 : 0;
  const Smooth shape(std::move(inside), width, height);
  const SmoothColours picture(rgb, width, height);
  const auto is_inside = [&](int x, int y) {
    return mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] != 0;
  };
  for (int y = border; y < height - border; ++y)
    for (int x = border; x < width - border; ++x) {
      if ((x + y) % 2 != 0 || !is_inside(x, y)) continue;
      if (is_inside(x - 1, y) && is_inside(x + 1, y) && is_inside(x, y - 1) && is_inside(x, y + 1)) continue;
      OutlinePoint point;
      point.at = {x + 0.5, y + 0.5};
      // Onto the line where the smoothed mask is a half.
      for (int round = 0; round < 3; ++round) {
        const auto [gx, gy] = shape.slope(point.at[0], point.at[1]);
        const double square = gx * gx + gy * gy;
        if (square < 1e-3) break;
        const double way = std::clamp((0.5 - shape.at(point.at[0], point.at[1])) / square, -4.0, 4.0);
        point.at[0] += std::clamp(way * gx, -1.0, 1.0), point.at[1] += std::clamp(way * gy, -1.0, 1.0);
      }
      const auto [gx, gy] = shape.slope(point.at[0], point.at[1]);
      const double length = std::hypot(gx, gy);
      if (length < 0.05) continue;  // thinner than the smoothing
      point.normal = {-gx / length, -gy / length};
      search(picture, options, point);
      points.push_back(point);
    }
  return points;
}

Alignment alignment_of(const std::vector<OutlinePoint>& points) {
  Alignment result;
  result.points = static_cast<std::int64_t>(points.size());
  std::vector<double> offsets;
  for (const OutlinePoint& point : points)
    if (point.found) offsets.push_back(std::abs(point.offset));
  result.found = static_cast<std::int64_t>(offsets.size());
  if (offsets.empty()) return result;
  std::sort(offsets.begin(), offsets.end());
  const auto share = [&](double p) {
    return offsets[static_cast<std::size_t>(p * static_cast<double>(offsets.size() - 1))];
  };
  result.median_px = share(0.5);
  result.p95_px = share(0.95);
  for (const double offset : offsets) result.mean_px += offset / static_cast<double>(offsets.size());
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix2d normal = 1e-9 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const OutlinePoint& point : points) {
      if (!point.found) continue;
      const Eigen::Vector2d n(point.normal[0], point.normal[1]);
      const double rest = std::abs(point.offset - n.dot(shift));
      const double weight = rest <= kHuber ? 1 : kHuber / rest;
      normal += weight * n * n.transpose();
      right += weight * point.offset * n;
    }
    shift = normal.ldlt().solve(right);
  }
  result.shift_px = {shift.x(), shift.y()};
  return result;
}

}  // namespace stampede
