// Included by one file for each set of instructions, inside a namespace of its own, after square_root(Floats).
// Arithmetic is of + - * / and square roots alone, which round alike everywhere.

constexpr int kLaneCount = static_cast<int>(kLanes);
constexpr double kSubpixels = 256;
constexpr double kGuard = 131072;  // pixels: numbers of subpixels and their products stay exact
constexpr Floats kSteps{0, 1, 2, 3, 4, 5, 6, 7};
constexpr Ints kIntSteps{0, 1, 2, 3, 4, 5, 6, 7};

struct Doubles3 {
  double x, y, z;
};
Doubles3 operator-(const Doubles3& a, const Doubles3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Doubles3& a, const Doubles3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Doubles3 cross(const Doubles3& a, const Doubles3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Doubles3 doubles(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }
Doubles3 doubles(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

template <typename Lanes, typename Number>
Lanes load(const Number* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}
template <typename Lanes, typename Number>
void store(Number* to, const Lanes& lanes) {
  __builtin_memcpy(to, &lanes, sizeof(lanes));
}
Floats all(float value) { return Floats{} + value; }
Floats greater_of(Floats a, Floats b) { return a > b ? a : b; }
Floats lesser_of(Floats a, Floats b) { return a < b ? a : b; }
Floats dot(const Floats (&a)[3], const Floats (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Floats dot(const Floats (&a)[3], const std::array<float, 3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
bool any(Ints mask) {
  std::uint64_t words[4];
  __builtin_memcpy(words, &mask, sizeof(words));
  return (words[0] | words[1] | words[2] | words[3]) != 0;
}

int ceil_of(double value) {
  const int whole = static_cast<int>(value);
  return whole + (value > whole ? 1 : 0);
}
int floor_of(float value) {
  const int whole = static_cast<int>(value);
  return whole - (value < static_cast<float>(whole) ? 1 : 0);
}

// ---- where a triangle lies

// A number over the picture: at the middle of the first pixel, and how it changes with a pixel right and down.
struct Plane {
  double first, right, down;
  float least, most;  // that a corner has: rounding beyond them is cut off
};

struct Corner {
  std::int32_t column, row;
};

// A side of a triangle: where it crosses the middles of rows, in pixels: the quotient of two whole numbers.
struct Side {
  double numerator, step, divisor;
  Side(const Corner& from, const Corner& to, int row) {
    const double across = static_cast<double>(to.column) - from.column, along = static_cast<double>(to.row) - from.row;
    divisor = kSubpixels * along;
    numerator = from.column * along + (kSubpixels * row - from.row) * across;
    step = kSubpixels * across;
  }
  int next() {
    const int column = ceil_of(numerator / divisor);
    numerator += step;
    return column;
  }
};

// The row or column whose middle is the first at a place or behind it.
int first_middle(std::int32_t place) { return (place + 255) >> 8; }

// A sink takes what lies inside of a triangle, row by row, on its surface.
template <typename Sink>
void fill_rows(int from, int to, Side left, Side right, Sink& sink) {
  const int width = sink.surface.width;
  for (int row = from; row < to; ++row) {
    const int begin = left.next(), end = right.next();
    const int first = begin < 0 ? 0 : begin, last = end > width ? width : end;
    if (first < last) sink.row(row, first, last);
  }
}

// Pixels whose middles lie inside; of a side that two triangles share, each pixel falls to one of them.
template <typename Sink>
void fill_corners(Corner a, Corner b, Corner c, Sink& sink) {
  if (b.row < a.row) std::swap(a, b);
  if (c.row < a.row) std::swap(a, c);
  if (c.row < b.row) std::swap(b, c);
  const int height = sink.surface.height;
  const auto within = [&](int row) { return row < 0 ? 0 : row > height ? height : row; };
  const int top = within(first_middle(a.row)), middle = within(first_middle(b.row)),
            bottom = within(first_middle(c.row));
  if (top >= bottom) return;
  const std::int64_t turn = static_cast<std::int64_t>(b.column - a.column) * (c.row - a.row) -
                            static_cast<std::int64_t>(c.column - a.column) * (b.row - a.row);
  if (turn == 0) return;
  const auto half = [&](int from, int to, const Corner& upper, const Corner& lower) {
    if (from >= to) return;
    const Side whole(a, c, from), part(upper, lower, from);
    if (turn > 0)
      fill_rows(from, to, whole, part, sink);
    else
      fill_rows(from, to, part, whole, sink);
  };
  half(top, middle, a, b);
  half(middle, bottom, b, c);
}

// Twice the area, in subpixels; rows run down, so fronts are negative.
std::int64_t area_of(const Corner& a, const Corner& b, const Corner& c) {
  return static_cast<std::int64_t>(b.column - a.column) * (c.row - a.row) -
         static_cast<std::int64_t>(c.column - a.column) * (b.row - a.row);
}

std::int32_t least_of(std::int32_t a, std::int32_t b, std::int32_t c) {
  const std::int32_t least = a < b ? a : b;
  return least < c ? least : c;
}
std::int32_t most_of(std::int32_t a, std::int32_t b, std::int32_t c) {
  const std::int32_t most = a > b ? a : b;
  return most > c ? most : c;
}

// Whether the middle of any pixel may lie inside: not beside the picture, nor between rows or columns.
bool may_show(const Corner& a, const Corner& b, const Corner& c, int width, int height) {
  const int left = first_middle(least_of(a.column, b.column, c.column)),
            right = first_middle(most_of(a.column, b.column, c.column)),
            top = first_middle(least_of(a.row, b.row, c.row)), bottom = first_middle(most_of(a.row, b.row, c.row));
  return left < right && top < bottom && left < width && top < height && right > 0 && bottom > 0;
}

// ---- triangles that reach behind the eye or far beside it, cut to what can be projected

struct Homogeneous {  // pixels times w
  double x, y, w;
};
struct Polygon {
  std::array<Homogeneous, 10> corners;
  int count = 0;
};

// The part where `inside` is not negative. A crossing is computed from its outer to its inner corner, so that two
// triangles agree on the side that they share.
template <typename Inside>
Polygon cut(const Polygon& polygon, const Inside& inside) {
  Polygon rest;
  for (int i = 0; i < polygon.count; ++i) {
    const Homogeneous& a = polygon.corners[static_cast<std::size_t>(i)];
    const Homogeneous& b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
    const double at_a = inside(a), at_b = inside(b);
    if (at_a >= 0) rest.corners[static_cast<std::size_t>(rest.count++)] = a;
    if ((at_a < 0) == (at_b < 0)) continue;
    const Homogeneous &out = at_a < 0 ? a : b, &in = at_a < 0 ? b : a;
    const double at_out = at_a < 0 ? at_a : at_b, at_in = at_a < 0 ? at_b : at_a, share = at_out / (at_out - at_in);
    rest.corners[static_cast<std::size_t>(rest.count++)] = {
        out.x + share * (in.x - out.x), out.y + share * (in.y - out.y), out.w + share * (in.w - out.w)};
  }
  return rest;
}

template <typename Sink>
void fill_cut(Polygon polygon, double least_w, bool two_sided, Sink& sink) {
  polygon = cut(polygon, [&](const Homogeneous& c) { return c.w - least_w; });
  polygon = cut(polygon, [](const Homogeneous& c) { return kGuard * c.w - c.x; });
  polygon = cut(polygon, [](const Homogeneous& c) { return kGuard * c.w + c.x; });
  polygon = cut(polygon, [](const Homogeneous& c) { return kGuard * c.w - c.y; });
  polygon = cut(polygon, [](const Homogeneous& c) { return kGuard * c.w + c.y; });
  std::array<Corner, 10> corners{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
    const Homogeneous& c = polygon.corners[i];
    corners[i] = {static_cast<std::int32_t>(c.x / c.w * kSubpixels - 127.5),
                  static_cast<std::int32_t>(c.y / c.w * kSubpixels - 127.5)};
  }
  for (std::size_t i = 2; i < static_cast<std::size_t>(polygon.count); ++i)
    if (two_sided || area_of(corners[0], corners[i - 1], corners[i]) < 0)
      fill_corners(corners[0], corners[i - 1], corners[i], sink);
}

// ---- corners

template <typename Project>
void place_corners(const ThingInEye& thing, const CornersInEye& corners, const Project& project) {
  const auto& places = thing.entry->places;
  const Rows& m = thing.eye_from_shape;
  const float *px = places[0].data(), *py = places[1].data(), *pz = places[2].data();
  const Floats guard = all(static_cast<float>(kGuard));
  for (std::size_t i = 0, end = places[0].size(); i < end; i += kLanes) {
    const Floats sx = load<Floats>(px + i), sy = load<Floats>(py + i), sz = load<Floats>(pz + i);
    const Floats x = m[0] * sx + m[1] * sy + m[2] * sz + m[3];
    const Floats y = m[4] * sx + m[5] * sy + m[6] * sz + m[7];
    const Floats z = m[8] * sx + m[9] * sy + m[10] * sz + m[11];
    Floats column, row;
    const Ints in_front = project(x, y, z, column, row);
    const Ints inside = in_front & (column < guard) & (column > -guard) & (row < guard) & (row > -guard);
    store(corners.x + i, x);
    store(corners.y + i, y);
    store(corners.z + i, z);
    store(corners.column + i, __builtin_convertvector(inside ? column * 256.0F - 127.5F : Floats{}, Ints));
    store(corners.row + i, __builtin_convertvector(inside ? row * 256.0F - 127.5F : Floats{}, Ints));
    store(corners.outside + i, ~inside);
  }
}

void place_in_pinhole(const PinholeOfEye& eye, const ThingInEye& thing, const CornersInEye& corners) {
  place_corners(thing, corners, [&](Floats x, Floats y, Floats z, Floats& column, Floats& row) {
    const Floats nearness = 1.0F / z;
    column = eye.focal_x * x * nearness + eye.centre_x;
    row = eye.focal_y * y * nearness + eye.centre_y;
    return z >= eye.near;
  });
}

// ---- opaque things

struct NearestSink {
  const SurfaceView& surface;
  Plane plane{};
  std::int32_t triangle = 0;

  void row(int y, int begin, int end) const {
    const std::size_t start =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(surface.width) + static_cast<std::size_t>(begin);
    float* nearness = surface.nearness + start;
    std::int32_t* triangles = surface.triangle + start;
    const auto first = static_cast<float>(plane.first + plane.right * begin + plane.down * y);
    const auto right = static_cast<float>(plane.right);
    for (int done = 0, count = end - begin; done < count; done += kLaneCount) {
      const Floats here =
          lesser_of(greater_of(first + right * (kSteps + static_cast<float>(done)), all(plane.least)), all(plane.most));
      const Floats there = load<Floats>(nearness + done);
      const Ints whose = load<Ints>(triangles + done);
      const Ints seen = (kIntSteps < count - done) & ((here > there) | ((here == there) & (whose > triangle)));
      store(nearness + done, seen ? here : there);
      store(triangles + done, seen ? Ints{} + triangle : whose);
    }
  }
};

// 1 / z over the picture of the plane through three points in the camera's frame. False: it is seen from its edge.
bool plane_of(const PinholeOfEye& eye, const Doubles3& a, const Doubles3& b, const Doubles3& c, Plane& plane) {
  const Doubles3 normal = cross(b - a, c - a);
  const double distance = dot(normal, a);
  if (distance == 0) return false;
  const double share = 1 / distance;
  plane.right = normal.x * share / eye.focal_x;
  plane.down = normal.y * share / eye.focal_y;
  plane.first = normal.z * share + plane.right * (0.5 - eye.centre_x) + plane.down * (0.5 - eye.centre_y);
  const double least_z = a.z < b.z ? (a.z < c.z ? a.z : c.z) : (b.z < c.z ? b.z : c.z);
  const double most_z = a.z > b.z ? (a.z > c.z ? a.z : c.z) : (b.z > c.z ? b.z : c.z);
  plane.least = static_cast<float>(1 / most_z);
  plane.most = static_cast<float>(1 / (least_z > eye.near ? least_z : eye.near));
  return true;
}

// Calls begin(triangle) for each triangle that faces the eye, and then fills it.
template <typename Sink, typename Begin>
void fill_thing(const PinholeOfEye& eye, const ThingInEye& thing, const CornersInEye& corners, Sink& sink,
                const Begin& begin) {
  const SurfaceView& surface = sink.surface;
  place_in_pinhole(eye, thing, corners);
  const auto& triangles = thing.entry->mesh.triangles;
  const auto count = static_cast<std::int32_t>(triangles.size());
  const auto at = [&](std::uint32_t i) { return Doubles3{corners.x[i], corners.y[i], corners.z[i]}; };
  const auto homogeneous = [&](const Doubles3& c) {
    return Homogeneous{eye.focal_x * c.x + eye.centre_x * c.z, eye.focal_y * c.y + eye.centre_y * c.z, c.z};
  };
  for (std::int32_t i = 0; i < count; ++i) {
    const auto [ia, ib, ic] = triangles.data()[i];
    const Corner a{corners.column[ia], corners.row[ia]}, b{corners.column[ib], corners.row[ib]},
        c{corners.column[ic], corners.row[ic]};
    const bool whole = (corners.outside[ia] | corners.outside[ib] | corners.outside[ic]) == 0;
    if (whole) {
      const std::int64_t area = area_of(a, b, c);
      if (area == 0 || (area > 0 && !thing.two_sided) || !may_show(a, b, c, surface.width, surface.height)) continue;
    } else if (corners.z[ia] < eye.near && corners.z[ib] < eye.near && corners.z[ic] < eye.near) {
      continue;
    }
    const Doubles3 pa = at(ia), pb = at(ib), pc = at(ic);
    if (!plane_of(eye, pa, pb, pc, sink.plane)) continue;
    begin(i);
    if (whole) {
      fill_corners(a, b, c, sink);
      continue;
    }
    const Polygon polygon{{homogeneous(pa), homogeneous(pb), homogeneous(pc)}, 3};
    fill_cut(polygon, eye.near, thing.two_sided, sink);
  }
}

void fill(const SurfaceView& surface, const PinholeOfEye& eye, const ThingInEye& thing, const CornersInEye& corners) {
  NearestSink sink{surface};
  fill_thing(eye, thing, corners, sink, [&](std::int32_t i) { sink.triangle = thing.first_triangle + i; });
}

// ---- depth as the lamp sees it

struct ShadowSink {
  const SurfaceView& surface;
  Plane plane{};

  void row(int y, int begin, int end) const {
    float* nearness = surface.nearness + static_cast<std::size_t>(y) * static_cast<std::size_t>(surface.width) +
                      static_cast<std::size_t>(begin);
    const auto first = static_cast<float>(plane.first + plane.right * begin + plane.down * y);
    const auto right = static_cast<float>(plane.right);
    for (int done = 0, count = end - begin; done < count; done += kLaneCount) {
      const Floats here =
          lesser_of(greater_of(first + right * (kSteps + static_cast<float>(done)), all(plane.least)), all(plane.most));
      const Floats there = load<Floats>(nearness + done);
      const Ints seen = (kIntSteps < count - done) & (here > there) & (here <= 1.0F);
      store(nearness + done, seen ? here : there);
    }
  }
};

bool plane_through(const Doubles3& a, const Doubles3& b, const Doubles3& c, Plane& plane) {
  const Doubles3 ab = b - a, ac = c - a;
  const double area = ab.x * ac.y - ac.x * ab.y;
  if (area == 0) return false;
  plane.right = (ab.z * ac.y - ac.z * ab.y) / area;
  plane.down = (ac.z * ab.x - ab.z * ac.x) / area;
  plane.first = a.z + plane.right * (0.5 - a.x) + plane.down * (0.5 - a.y);
  plane.least = static_cast<float>(a.z < b.z ? (a.z < c.z ? a.z : c.z) : (b.z < c.z ? b.z : c.z));
  plane.most = static_cast<float>(a.z > b.z ? (a.z > c.z ? a.z : c.z) : (b.z > c.z ? b.z : c.z));
  return true;
}

void fill_shadow(const SurfaceView& surface, const ThingInEye& thing, const CornersInEye& corners) {
  place_corners(thing, corners, [](Floats x, Floats y, Floats z, Floats& column, Floats& row) {
    column = x;
    row = y;
    return z == z;
  });
  ShadowSink sink{surface};
  for (const auto& [ia, ib, ic] : thing.entry->mesh.triangles) {
    const auto at = [&](std::uint32_t i) { return Doubles3{corners.x[i], corners.y[i], corners.z[i]}; };
    const Corner a{corners.column[ia], corners.row[ia]}, b{corners.column[ib], corners.row[ib]},
        c{corners.column[ic], corners.row[ic]};
    const bool whole = (corners.outside[ia] | corners.outside[ib] | corners.outside[ic]) == 0;
    if (whole) {
      const std::int64_t area = area_of(a, b, c);
      if (area == 0 || (area > 0 && !thing.two_sided) || !may_show(a, b, c, surface.width, surface.height)) continue;
    }
    const Doubles3 pa = at(ia), pb = at(ib), pc = at(ic);
    if (!plane_through(pa, pb, pc, sink.plane)) continue;
    if (whole) {
      fill_corners(a, b, c, sink);
      continue;
    }
    const Polygon polygon{{Homogeneous{pa.x, pa.y, 1}, Homogeneous{pb.x, pb.y, 1}, Homogeneous{pc.x, pc.y, 1}}, 3};
    fill_cut(polygon, 1, thing.two_sided, sink);
  }
}

// ---- colours

// Each corner's share over z, over the picture: linear there.
struct Shares {
  double first[3], right[3], down[3];
  double side;  // -1: seen from behind
};

Shares shares_of(const ThingPaint& thing, std::int32_t triangle) {
  const auto& mesh = thing.entry->mesh;
  const auto& corners = mesh.triangles.data()[triangle];
  const Doubles3 eye = doubles(thing.eye);
  const Doubles3 a = doubles(mesh.positions.data()[corners[0]]) - eye,
                 b = doubles(mesh.positions.data()[corners[1]]) - eye,
                 c = doubles(mesh.positions.data()[corners[2]]) - eye;
  const double volume = dot(a, cross(b, c));
  const double share = volume == 0 ? 0 : 1 / volume;
  const Doubles3 of[3] = {cross(b, c), cross(c, a), cross(a, b)};
  Shares shares;
  for (int i = 0; i < 3; ++i) {
    shares.first[i] = dot(of[i], doubles(thing.ray[0])) * share;
    shares.right[i] = dot(of[i], doubles(thing.ray[1])) * share;
    shares.down[i] = dot(of[i], doubles(thing.ray[2])) * share;
  }
  shares.side = volume < 0 ? 1 : -1;  // corners run counter-clockwise seen from outside
  return shares;
}

// Of values at the corners, over z.
template <typename ValueOf>
void spread(const Shares& shares, const ValueOf& value_of, float& first, float& right, float& down) {
  double sums[3] = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = value_of(i);
    sums[0] += shares.first[i] * value;
    sums[1] += shares.right[i] * value;
    sums[2] += shares.down[i] * value;
  }
  first = static_cast<float>(sums[0]);
  right = static_cast<float>(sums[1]);
  down = static_cast<float>(sums[2]);
}

void find_normals(const ThingPaint& thing, std::int32_t triangle, NormalPlane& plane) {
  const auto& mesh = thing.entry->mesh;
  const auto& corners = mesh.triangles.data()[triangle];
  const std::array<float, 3>*normals = mesh.normals.data(), &a = normals[corners[0]];
  const Shares shares = shares_of(thing, triangle);
  if (a == normals[corners[1]] && a == normals[corners[2]]) {
    plane.right = plane.down = {};
    for (std::size_t k = 0; k < 3; ++k) plane.first[k] = static_cast<float>(shares.side) * a[k];
    return;
  }
  for (std::size_t k = 0; k < 3; ++k)
    spread(
        shares, [&](std::size_t i) { return shares.side * normals[corners[i]][k]; }, plane.first[k], plane.right[k],
        plane.down[k]);
}

struct TexturePlanes {
  TextureLevels levels;
  float first[3], right[3], down[3];                 // of the coordinates
  float side_first[3], side_right[3], side_down[3];  // of the normal in the shape's frame
  float nearness_right, nearness_down;
  bool own;
};

TexturePlanes find_texture(const ThingPaint& thing, std::int32_t triangle) {
  const auto& mesh = thing.entry->mesh;
  const auto& corners = mesh.triangles.data()[triangle];
  const Shares shares = shares_of(thing, triangle);
  TexturePlanes planes{};
  planes.levels = thing.texture;
  planes.own = !mesh.coordinates.empty();
  const auto coordinate = [&](std::size_t corner, std::size_t k) {
    if (!planes.own) return mesh.positions.data()[corner][k] * thing.texture_scale;
    return k < 2 ? mesh.coordinates.data()[corner][k] : 0.0F;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    spread(
        shares, [&](std::size_t i) { return coordinate(corners[i], k); }, planes.first[k], planes.right[k],
        planes.down[k]);
    spread(
        shares, [&](std::size_t i) { return mesh.normals.data()[corners[i]][k]; }, planes.side_first[k],
        planes.side_right[k], planes.side_down[k]);
  }
  planes.nearness_right = static_cast<float>(shares.right[0] + shares.right[1] + shares.right[2]);
  planes.nearness_down = static_cast<float>(shares.down[0] + shares.down[1] + shares.down[2]);
  return planes;
}

// Within 0.01: a parabola between powers of two.
float log2_of(float value) {
  std::uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof(bits));
  const float exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
  bits = (bits & 0x007fffffU) | 0x3f800000U;
  float mantissa;
  __builtin_memcpy(&mantissa, &bits, sizeof(mantissa));
  return exponent + (-mantissa / 3 + 2) * mantissa - 5.0F / 3;
}

struct Neighbours {
  std::size_t first, second;
  float share;  // of the second
};
Neighbours neighbours(float repeats, int size) {
  const float within = repeats - static_cast<float>(floor_of(repeats));
  const float at = within * static_cast<float>(size) - 0.5F;
  const int whole = floor_of(at);
  const auto wrapped = [&](int i) { return static_cast<std::size_t>(i < 0 ? i + size : i >= size ? i - size : i); };
  return {wrapped(whole), wrapped(whole + 1), at - static_cast<float>(whole)};
}

void add_level(const TextureLevel& level, float u, float v, float weight, float (&sum)[3]) {
  const Neighbours across = neighbours(u, level.width), along = neighbours(v, level.height);
  const std::size_t width = static_cast<std::size_t>(level.width);
  const auto add = [&](std::size_t x, std::size_t y, float share) {
    const std::uint32_t texel = level.texels[y * width + x];
    for (int k = 0; k < 3; ++k) sum[k] += share * static_cast<float>(texel >> (8 * k) & 255);
  };
  add(across.first, along.first, weight * (1 - across.share) * (1 - along.share));
  add(across.second, along.first, weight * across.share * (1 - along.share));
  add(across.first, along.second, weight * (1 - across.share) * along.share);
  add(across.second, along.second, weight * across.share * along.share);
}

// `steps`: how far the coordinates move with a pixel right, and down. As OpenGL's LINEAR_MIPMAP_LINEAR.
void sample(const TextureLevels& texture, const float (&at)[2], const float (&steps)[2][2], float (&colour)[3]) {
  const auto width = static_cast<float>(texture.levels[0].width), height = static_cast<float>(texture.levels[0].height);
  float longest = 0;
  for (const auto& step : steps) {
    const float x = step[0] * width, y = step[1] * height, square = x * x + y * y;
    if (square > longest) longest = square;
  }
  float sum[3] = {0, 0, 0};
  const float level = longest > 1 ? 0.5F * log2_of(longest) : 0.0F;
  const int last = texture.count - 1;
  if (!(level < static_cast<float>(last))) {
    add_level(texture.levels[last], at[0], at[1], 1, sum);
  } else {
    const int whole = static_cast<int>(level);
    const float share = level - static_cast<float>(whole);
    add_level(texture.levels[whole], at[0], at[1], 1 - share, sum);
    if (share > 0) add_level(texture.levels[whole + 1], at[0], at[1], share, sum);
  }
  for (int k = 0; k < 3; ++k) colour[k] = sum[k] / 255;
}

// The axis that the surface faces most is left out; a mesh with coordinates of its own wears them.
void paint_pixel(const TexturePlanes& planes, float x, float y, float nearness, float (&colour)[3]) {
  float at[3], right[3], down[3], side[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = (planes.first[k] + planes.right[k] * x + planes.down[k] * y) / nearness;
    right[k] = (planes.right[k] - at[k] * planes.nearness_right) / nearness;
    down[k] = (planes.down[k] - at[k] * planes.nearness_down) / nearness;
    const float facing = planes.side_first[k] + planes.side_right[k] * x + planes.side_down[k] * y;
    side[k] = facing < 0 ? -facing : facing;
  }
  int u = 0, v = 1;
  if (!planes.own && side[2] < (side[0] > side[1] ? side[0] : side[1])) {
    u = side[0] >= side[1] ? 1 : 0;
    v = 2;
  }
  const float steps[2][2] = {{right[u], right[v]}, {down[u], down[v]}};
  const float chosen[2] = {at[u], at[v]};
  sample(planes.levels, chosen, steps, colour);
}

// Two comparing samples beside a place, each between two texels, along one axis. Both axes together: four and sixteen.
struct ShadowTaps {
  Ints first;
  Floats weights[4];
  ShadowTaps(Floats texels, int side) {
    const Floats within = lesser_of(greater_of(texels, all(2)), all(static_cast<float>(side - 4)));
    const Floats before = within - 1.25F, after = within + 0.25F;  // the middle of a texel lies at its half
    first = __builtin_convertvector(before, Ints);
    const Ints second = __builtin_convertvector(after, Ints), apart = second - first;  // 1 or 2
    const Floats a = before - __builtin_convertvector(first, Floats),
                 b = after - __builtin_convertvector(second, Floats);
    const Floats near = 0.5F - 0.5F * b, far = 0.5F * b;
    weights[0] = 0.5F - 0.5F * a;
    weights[1] = 0.5F * a + (apart == 1 ? near : Floats{});
    weights[2] = apart == 1 ? far : near;
    weights[3] = apart == 1 ? Floats{} : far;
  }
};

// How much of the lamp each place sees.
Floats lit_share(const LampPaint& lamp, Floats column, Floats row, Floats nearness) {
  const Floats reference = greater_of(nearness, Floats{});
  const ShadowTaps across(column, lamp.shadow_side), along(row, lamp.shadow_side);
  const Ints start = along.first * lamp.shadow_side + across.first;
  Floats share{};
  for (int j = 0; j < 4; ++j) {
    Floats lit{};
    for (int i = 0; i < 4; ++i) {
      Floats there{};
      for (int lane = 0; lane < kLaneCount; ++lane)
        there[lane] = lamp.shadow_map[start[lane] + j * lamp.shadow_side + i];
      lit += reference >= there ? across.weights[i] : Floats{};
    }
    share += along.weights[j] * lit;
  }
  return share;
}

// One triangle's pixels of a row, eight at a time.
struct Brush {
  const ThingPaint& thing;
  const LampPaint& lamp;
  const NormalPlane& normal;
  const TexturePlanes* texture;  // null: plain

  void paint_texture(Floats (&base)[3], float x, float y, Floats nearness, Ints wanted) const {
    for (int lane = 0; lane < kLaneCount; ++lane) {
      if (wanted[lane] == 0) continue;
      float colour[3];
      paint_pixel(*texture, x + static_cast<float>(lane), y, nearness[lane], colour);
      for (int k = 0; k < 3; ++k) base[k][lane] *= colour[k];
    }
  }

  Floats shadow(const Floats (&n)[3], Floats per_length, const Floats (&ray)[3], Floats nearness) const {
    Floats place[3];
    for (std::size_t k = 0; k < 3; ++k)
      place[k] = static_cast<float>(thing.eye[k]) + ray[k] / nearness + lamp.shadow_offset * per_length * n[k];
    const Rows& m = thing.shadow_from_shape;
    const Floats column = m[0] * place[0] + m[1] * place[1] + m[2] * place[2] + m[3];
    const Floats row = m[4] * place[0] + m[5] * place[1] + m[6] * place[2] + m[7];
    const Floats height = m[8] * place[0] + m[9] * place[1] + m[10] * place[2] + m[11];
    return lit_share(lamp, column, row, height);
  }

  // Red, green and blue of 0 … 255, not rounded.
  void colours(int column, int line, Floats nearness, Ints wanted, Floats (&value)[3]) const {
    const Floats x = kSteps + static_cast<float>(column);
    const auto y = static_cast<float>(line);
    Floats ray[3], n[3];
    for (std::size_t k = 0; k < 3; ++k) {
      ray[k] = static_cast<float>(thing.ray[0][k] + thing.ray[2][k] * line) + static_cast<float>(thing.ray[1][k]) * x;
      n[k] = normal.first[k] + normal.down[k] * y + normal.right[k] * x;
    }
    const Floats per_length = 1.0F / square_root(dot(n, n));
    const Floats lambert = greater_of(dot(n, thing.towards_light) * per_length, Floats{});
    const Floats around = 0.82F + dot(n, thing.around) * per_length;
    const Floats per_ray = 1.0F / square_root(dot(ray, ray));
    Floats halfway[3];
    for (std::size_t k = 0; k < 3; ++k) halfway[k] = thing.towards_light[k] - ray[k] * per_ray;
    Floats shine = greater_of(dot(n, halfway) * per_length / square_root(dot(halfway, halfway)), Floats{});
    for (int i = 0; i < 5; ++i) shine *= shine;
    Floats diffuse = lamp.diffuse * lambert, specular = lambert > 0.0F ? lamp.specular * shine : Floats{};
    if (lamp.shadow_map != nullptr) {
      const Floats share = shadow(n, per_length, ray, nearness);
      diffuse *= share;
      specular *= share;
    }
    Floats base[3] = {all(thing.colour[0]), all(thing.colour[1]), all(thing.colour[2])};
    if (texture != nullptr) paint_texture(base, static_cast<float>(column), y, nearness, wanted);
    for (std::size_t k = 0; k < 3; ++k) {
      value[k] = 255.0F * lamp.colour[k] * (base[k] * (lamp.ambient * around + diffuse) + specular);
      value[k] = lesser_of(greater_of(value[k], Floats{}), all(255));  // what is no number is 0
    }
  }
};

Ints packed(const Floats (&value)[3]) {
  const Ints red = __builtin_convertvector(value[0] + 0.5F, Ints),
             green = __builtin_convertvector(value[1] + 0.5F, Ints),
             blue = __builtin_convertvector(value[2] + 0.5F, Ints);
  return red | (green << 8) | (blue << 16);
}

// Pixels of a row that show the same triangle.
struct Run {
  std::int32_t triangle;
  int row, begin, end;
};

void shade_run(const SurfaceView& surface, const PaintJob& job, const ThingPaint& thing, const Run& run) {
  NormalPlane& normal = job.normals[run.triangle];
  if (normal.stamp != job.stamp) {
    find_normals(thing, run.triangle - thing.first_triangle, normal);
    normal.stamp = job.stamp;
  }
  TexturePlanes planes;
  if (thing.texture.count > 0) planes = find_texture(thing, run.triangle - thing.first_triangle);
  const Brush brush{thing, job.lamp, normal, thing.texture.count > 0 ? &planes : nullptr};
  const std::size_t start = static_cast<std::size_t>(run.row) * static_cast<std::size_t>(surface.width);
  const float* nearness = surface.nearness + start;
  std::uint32_t* colours = surface.colours + start;
  for (int x = run.begin, end = run.end; x < end; x += kLaneCount) {
    const Ints wanted = kIntSteps < end - x;
    Floats value[3];
    brush.colours(x, run.row, load<Floats>(nearness + x), wanted, value);
    const Ints old = load<Ints>(colours + x);
    store(colours + x, wanted ? packed(value) : old);
  }
}

void shade(const SurfaceView& surface, const PaintJob& job) {
  for (int row = 0; row < surface.height; ++row) {
    const std::int32_t* triangles =
        surface.triangle + static_cast<std::size_t>(row) * static_cast<std::size_t>(surface.width);
    for (int x = 0; x < surface.width;) {
      const std::int32_t triangle = triangles[x];
      const int begin = x;
      while (x + kLaneCount <= surface.width && !any(load<Ints>(triangles + x) != triangle)) x += kLaneCount;
      while (x < surface.width && triangles[x] == triangle) ++x;
      if (triangle == kNoTriangle) continue;
      const std::int32_t thing = job.thing_of_triangle[triangle];
      if (job.wanted[thing] != 0) shade_run(surface, job, job.things[thing], {triangle, row, begin, x});
    }
  }
}

// ---- translucent things

struct TintSink {
  const SurfaceView& surface;
  const ThingPaint& thing;
  const LampPaint& lamp;
  Plane plane{};
  NormalPlane normal{};
  TexturePlanes texture{};

  void row(int y, int begin, int end) const {
    const std::size_t start = static_cast<std::size_t>(y) * static_cast<std::size_t>(surface.width);
    const float* nearness = surface.nearness + start;
    std::uint32_t* colours = surface.colours + start;
    const auto first = static_cast<float>(plane.first + plane.right * begin + plane.down * y);
    const auto right = static_cast<float>(plane.right);
    const Brush brush{thing, lamp, normal, thing.texture.count > 0 ? &texture : nullptr};
    for (int x = begin; x < end; x += kLaneCount) {
      const Floats here = lesser_of(
          greater_of(first + right * (kSteps + static_cast<float>(x - begin)), all(plane.least)), all(plane.most));
      const Ints seen = (kIntSteps < end - x) & (here > load<Floats>(nearness + x));
      if (!any(seen)) continue;
      Floats value[3];
      brush.colours(x, y, here, seen, value);
      const Ints old = load<Ints>(colours + x);
      for (int k = 0; k < 3; ++k) {
        const Floats behind = __builtin_convertvector((old >> (8 * k)) & 255, Floats);
        value[k] = value[k] * thing.alpha + behind * (1 - thing.alpha);
      }
      store(colours + x, seen ? packed(value) : old);
    }
  }
};

void tint(const SurfaceView& surface, const PinholeOfEye& eye, const ThingInEye& thing, const CornersInEye& corners,
          const TintJob& job) {
  TintSink sink{surface, job.thing, job.lamp};
  fill_thing(eye, thing, corners, sink, [&](std::int32_t i) {
    find_normals(job.thing, i, sink.normal);
    if (job.thing.texture.count > 0) sink.texture = find_texture(job.thing, i);
  });
}

// ---- pictures

std::size_t pixels_of(const SurfaceView& surface) {
  return static_cast<std::size_t>(surface.width) * static_cast<std::size_t>(surface.height);
}

void write_colours(const SurfaceView& surface, std::uint8_t* rgb) {
  const std::uint32_t* colours = surface.colours;
  using Bytes = std::uint8_t __attribute__((vector_size(16)));
  const std::size_t count = pixels_of(surface);
  std::size_t i = 0;
  for (; i + 6 <= count; i += 4) {  // four bytes too many each, which the next overwrite
    const Bytes four = load<Bytes>(colours + i);
    store(rgb + 3 * i, __builtin_shufflevector(four, four, 0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 3, 7, 11, 15));
  }
  for (; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) rgb[3 * i + k] = static_cast<std::uint8_t>(colours[i] >> (8 * k));
}

void write_depth(const SurfaceView& surface, float* depth) {
  const std::size_t count = pixels_of(surface);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Floats there = 1.0F / load<Floats>(surface.nearness + i);
    const Floats lanes = load<Ints>(surface.triangle + i) == kNoTriangle ? Floats{} : there;
    if (i + kLanes <= count)
      store(depth + i, lanes);
    else
      __builtin_memcpy(depth + i, &lanes, (count - i) * sizeof(float));
  }
}

void write_ids(const SurfaceView& surface, const std::uint32_t* ids, std::uint16_t* low, std::uint16_t* high) {
  using Shorts = std::uint16_t __attribute__((vector_size(16)));
  const std::size_t count = pixels_of(surface);
  const auto id_of = [&](std::int32_t triangle) { return triangle == kNoTriangle ? 0 : ids[triangle]; };
  for (std::size_t i = 0; i < count;) {
    const std::int32_t triangle = surface.triangle[i];
    const std::uint32_t id = id_of(triangle);
    if (i + kLanes <= count && !any(load<Ints>(surface.triangle + i) != triangle)) {
      if (low != nullptr) store(low + i, Shorts{} + static_cast<std::uint16_t>(id));
      if (high != nullptr) store(high + i, Shorts{} + static_cast<std::uint16_t>(id >> 16));
      i += kLanes;
      continue;
    }
    if (low != nullptr) low[i] = static_cast<std::uint16_t>(id);
    if (high != nullptr) high[i] = static_cast<std::uint16_t>(id >> 16);
    ++i;
  }
}

constexpr PixelKernels kKernels{fill, fill_shadow, shade, tint, write_colours, write_depth, write_ids};
