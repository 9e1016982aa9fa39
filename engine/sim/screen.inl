// Included by screen_plain.cpp and screen_avx2.cpp, each in a namespace of its own. Includes nothing itself.

typedef float Lanes __attribute__((vector_size(32)));
typedef int Mask __attribute__((vector_size(32)));

struct Vec {
  Lanes x, y, z;
};
constexpr int kPlaced = 16;  // shapes of a lump that are placed once

struct Frame {
  Lanes r[9];  // row by row
  Vec t;
};

inline Lanes all(float x) { return Lanes{x, x, x, x, x, x, x, x}; }
inline Lanes greater(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
inline Lanes lesser(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
inline Lanes magnitude(const Lanes& a) { return (Lanes)((Mask)a & 0x7fffffff); }

inline Lanes root(const Lanes& a) {
#ifdef STAMPEDE_SCREEN_AVX2
  return __builtin_ia32_sqrtps256(a);
#else
  Lanes result = a;
  for (int i = 0; i < kScreenLanes; ++i) result[i] = __builtin_sqrtf(a[i]);
  return result;
#endif
}

inline unsigned bits(const Mask& mask) {
#ifdef STAMPEDE_SCREEN_AVX2
  return static_cast<unsigned>(__builtin_ia32_movmskps256((Lanes)mask));
#else
  unsigned result = 0;
  for (int i = 0; i < kScreenLanes; ++i) result |= static_cast<unsigned>(mask[i] != 0) << i;
  return result;
#endif
}

inline float least_of(Lanes a) {
  a = lesser(a, __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3));
  a = lesser(a, __builtin_shufflevector(a, a, 2, 3, 0, 1, 6, 7, 4, 5));
  a = lesser(a, __builtin_shufflevector(a, a, 1, 0, 3, 2, 5, 4, 7, 6));
  return a[0];
}
inline float greatest_of(const Lanes& a) { return -least_of(-a); }

inline Lanes load(const float* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

inline Lanes dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec turned(const Frame& f, const Vec& v) {
  return {f.r[0] * v.x + f.r[1] * v.y + f.r[2] * v.z, f.r[3] * v.x + f.r[4] * v.y + f.r[5] * v.z,
          f.r[6] * v.x + f.r[7] * v.y + f.r[8] * v.z};
}
inline Vec turned_back(const Frame& f, const Vec& v) {
  return {f.r[0] * v.x + f.r[3] * v.y + f.r[6] * v.z, f.r[1] * v.x + f.r[4] * v.y + f.r[7] * v.z,
          f.r[2] * v.x + f.r[5] * v.y + f.r[8] * v.z};
}
inline Vec point(const Frame& f, const float* at) {
  return {f.t.x + f.r[0] * at[0] + f.r[1] * at[1] + f.r[2] * at[2],
          f.t.y + f.r[3] * at[0] + f.r[4] * at[1] + f.r[5] * at[2],
          f.t.z + f.r[6] * at[0] + f.r[7] * at[1] + f.r[8] * at[2]};
}

inline void compose(Frame& out, const Frame& f, const float* turn, const float* at) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      out.r[3 * row + column] =
          f.r[3 * row] * turn[column] + f.r[3 * row + 1] * turn[3 + column] + f.r[3 * row + 2] * turn[6 + column];
  out.t = point(f, at);
}

inline void still(Frame& f) {
  for (int i = 0; i < 9; ++i) f.r[i] = all(i % 4 == 0 ? 1.0F : 0.0F);
  f.t = {all(0), all(0), all(0)};
}

// Angles from -pi to pi: a quarter turn's polynomials (Cephes), within 2e-7.
inline void sine_cosine(const Lanes& angle, Lanes& sine, Lanes& cosine) {
  const Lanes magic = all(12582912.0F);  // 1.5 * 2^23: adding it rounds
  const Lanes quarters = (angle * 0.636619772F + magic) - magic;
  const Lanes x = (angle - quarters * 1.5703125F) - quarters * 4.83826794897e-4F;
  const Lanes square = x * x;
  const Lanes s = ((all(-1.9515295891e-4F) * square + 8.3321608736e-3F) * square - 1.6666654611e-1F) * square * x + x;
  const Lanes c = ((all(2.443315711809948e-5F) * square - 1.388731625493765e-3F) * square + 4.166664568298827e-2F) *
                      square * square -
                  0.5F * square + 1.0F;
  const Lanes size = magnitude(quarters);
  const Mask odd = size == 1.0F, back = size == 2.0F;
  sine = odd ? (quarters < 0.0F ? -c : c) : (back ? -s : s);
  cosine = odd ? (quarters < 0.0F ? s : -s) : (back ? -c : c);
}

inline void move(Frame& out, const Frame& before, const ScreenJoint& joint, const Lanes& position) {
  compose(out, before, joint.turn, joint.at);
  if (joint.slides) {
    out.t.x += out.r[2] * position;
    out.t.y += out.r[5] * position;
    out.t.z += out.r[8] * position;
    return;
  }
  Lanes sine, cosine;
  sine_cosine(position, sine, cosine);
  for (int row = 0; row < 9; row += 3) {
    const Lanes x = out.r[row], y = out.r[row + 1];
    out.r[row] = x * cosine + y * sine;
    out.r[row + 1] = y * cosine - x * sine;
  }
}

// Where a point is, seen from a shape that stands still.
inline Vec seen_from(const ScreenShape& shape, const Vec& p) {
  const Lanes x = p.x - shape.at[0], y = p.y - shape.at[1], z = p.z - shape.at[2];
  if (!shape.turned) return {x, y, z};
  const float* r = shape.turn;
  return {x * r[0] + y * r[3] + z * r[6], x * r[1] + y * r[4] + z * r[7], x * r[2] + y * r[5] + z * r[8]};
}

// From the nearest point of the shape without its rounding.
inline Vec from_shape(const ScreenShape& shape, const Vec& p) {
  if (shape.radius > 0) {
    const Lanes across = root(p.x * p.x + p.y * p.y);
    const Lanes share = greater(across - shape.radius, all(0)) / greater(across, all(1e-9F));
    const Lanes top = lesser(greater(p.z, all(-shape.half[2])), all(shape.half[2]));
    return {p.x * share, p.y * share, p.z - top};
  }
  return {p.x - lesser(greater(p.x, all(-shape.half[0])), all(shape.half[0])),
          p.y - lesser(greater(p.y, all(-shape.half[1])), all(shape.half[1])),
          p.z - lesser(greater(p.z, all(-shape.half[2])), all(shape.half[2]))};
}

inline Lanes gap_to_ball(const ScreenShape& shape, const Vec& p) {
  const Vec v = from_shape(shape, p);
  return root(dot(v, v)) - shape.rounding;
}

// How far the shape reaches in a direction of its own frame.
inline Lanes reach(const ScreenShape& shape, const Vec& n) {
  if (shape.radius > 0)
    return shape.half[2] * magnitude(n.z) + shape.radius * root(n.x * n.x + n.y * n.y) + shape.rounding;
  return shape.half[0] * magnitude(n.x) + shape.half[1] * magnitude(n.y) + shape.half[2] * magnitude(n.z) +
         shape.rounding;
}

// Is some plane, with its normal towards `v`, surely more than `most` wide between them?
inline Mask apart_along(const ScreenShape& still, const ScreenShape& moving, const Frame& pose, const Vec& v,
                        const Lanes& most) {
  const Lanes scale = 1.0F / greater(root(dot(v, v)), all(1e-6F));
  const Vec n = {v.x * scale, v.y * scale, v.z * scale};
  return dot(n, pose.t) - reach(still, n) - reach(moving, turned_back(pose, n)) > most;
}

// The lanes in which two shapes are surely more than `most` apart. `pose` of the moving one, seen from the other.
// Separating axes (Gottschalk, Lin, Manocha, SIGGRAPH 1996): the sides of both, and the way from one to the other.
inline unsigned apart(const ScreenShape& still, const ScreenShape& moving, const Frame& pose, const Lanes& most) {
  const Lanes at[3] = {pose.t.x, pose.t.y, pose.t.z};
  Mask yes = {0, 0, 0, 0, 0, 0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const Vec row = {pose.r[3 * i], pose.r[3 * i + 1], pose.r[3 * i + 2]};
    const float own = (still.radius > 0 && i < 2 ? still.radius : still.half[i]) + still.rounding;
    yes |= magnitude(at[i]) - own - reach(moving, row) > most;
  }
  if (bits(yes) == 0xff) return 0xff;
  const Vec straight = from_shape(still, pose.t);
  yes |= apart_along(still, moving, pose, straight, most);
  if (bits(yes) == 0xff) return 0xff;
  for (int k = moving.radius > 0 ? 2 : 0; k < 3; ++k) {
    const Vec n = {pose.r[k], pose.r[3 + k], pose.r[6 + k]};
    const float own = moving.half[k] + moving.rounding;
    yes |= magnitude(dot(n, pose.t)) - own - reach(still, n) > most;
  }
  if (bits(yes) == 0xff) return 0xff;
  // From the point of the moving one that is nearest to where the way so far ends.
  const Vec end = {-straight.x, -straight.y, -straight.z};
  const Vec inner = turned_back(pose, end);
  const Vec rest = from_shape(moving, inner);
  const Vec on = {inner.x - rest.x, inner.y - rest.y, inner.z - rest.z};
  const Vec q = turned(pose, on);
  yes |= apart_along(still, moving, pose, from_shape(still, {q.x + pose.t.x, q.y + pose.t.y, q.z + pose.t.z}), most);
  return bits(yes);
}

// The lanes in which a ball of the moving shape's core is at most `most` from the other.
inline unsigned core_meets(const ScreenShape& still, const ScreenShape& moving, const Frame& pose, const Lanes& most) {
  if (!still.exact || moving.core_count == 0) return 0;
  const int k = moving.core_axis;
  Mask yes = {0, 0, 0, 0, 0, 0, 0, 0};
  for (int i = 0; i < moving.core_count; ++i) {
    const float along =
        moving.core_count == 1
            ? 0.0F
            : moving.core_reach * (2.0F * static_cast<float>(i) / static_cast<float>(moving.core_count - 1) - 1.0F);
    const Vec p = {pose.t.x + pose.r[k] * along, pose.t.y + pose.r[3 + k] * along, pose.t.z + pose.r[6 + k] * along};
    yes |= gap_to_ball(still, p) - moving.core_radius <= most;
  }
  return bits(yes);
}

// The pose of a placed shape, seen from one that stands still.
inline Frame relative(const ScreenShape& shape, const Frame& pose) {
  Frame out;
  out.t = seen_from(shape, pose.t);
  if (!shape.turned) {
    for (int i = 0; i < 9; ++i) out.r[i] = pose.r[i];
    return out;
  }
  const float* r = shape.turn;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      out.r[3 * row + column] =
          pose.r[column] * r[row] + pose.r[3 + column] * r[3 + row] + pose.r[6 + column] * r[6 + row];
  return out;
}

// What moves further apart than `most` surely does not touch, what is as near as `least` surely does.
struct Gaps {
  Lanes most, least;
};

// A lump's shapes where they are now. The first of them are placed once, when they are first asked for.
struct PlacedLump {
  PlacedLump(const ScreenTables& tables, const ScreenLump& lump_in, const Frame& frame_in)
      : lump(lump_in),
        frame(frame_in),
        shapes(tables.shapes + lump_in.begin),
        count(lump_in.end - lump_in.begin),
        kept(count < kPlaced ? count : kPlaced),
        centre(point(frame_in, lump_in.middle)) {}

  const Frame& pose(int shape) {
    for (; placed < kept; ++placed) compose(poses[placed], frame, shapes[placed].turn, shapes[placed].at);
    if (shape < kept) return poses[shape];
    compose(further, frame, shapes[shape].turn, shapes[shape].at);
    return further;
  }

  const ScreenLump& lump;
  const Frame& frame;
  const ScreenShape* const shapes;
  const int count, kept;
  const Vec centre;
  int placed = 0;
  Frame poses[kPlaced], further;
};

// Of one batch. With `any`, it ends with the first lane that surely touches.
class Screening {
 public:
  Screening(const ScreenTables& tables, ScreenBatch& batch, bool any) : tables_(tables), batch_(batch), any_(any) {
    batch.doubt_count = 0;
    batch.overflowing = 0;
    still(frames_[0]);
    for (int j = 0; j < tables.joint_count; ++j)
      move(frames_[j + 1], frames_[j], tables.joints[j], load(batch.positions[j]));
  }

  unsigned char touching() {
    const Lanes padding = load(batch_.padding);
    const Gaps gaps = {padding + tables_.slack, padding - tables_.slack};
    const float farthest = greatest_of(gaps.most);
    for (int l = 0; l < tables_.lump_count && !decided(); ++l)
      if (tables_.lumps[l].frame != 0) look_around(tables_.lumps[l], gaps, farthest);
    for (int m = 0; m < tables_.meeting_count && !decided(); ++m) look_between(tables_.meetings[m]);
    return static_cast<unsigned char>(touching_);
  }

 private:
  bool decided() const { return any_ && touching_ != 0; }

  // One shape that stands still against one that moves.
  void meet(const ScreenShape& still, const ScreenShape& moving, const Frame& pose, const Gaps& gaps,
            const ScreenDoubt& which) {
    const Vec centre = seen_from(still, pose.t);
    if (bits(gap_to_ball(still, centre) - moving.ball > gaps.most) == 0xff) return;
    const Frame seen = relative(still, pose);
    unsigned doubtful = ~apart(still, moving, seen, gaps.most) & 0xff & ~touching_;
    if (doubtful == 0) return;
    touching_ |= core_meets(still, moving, seen, gaps.least);
    doubtful &= ~touching_;
    if (doubtful == 0) return;
    if (batch_.doubt_count == kScreenDoubts) {
      batch_.overflowing = static_cast<unsigned char>(batch_.overflowing | doubtful);
      return;
    }
    ScreenDoubt& doubt = batch_.doubts[batch_.doubt_count++];
    doubt = which;
    doubt.lanes = static_cast<unsigned char>(doubtful);
  }

  // A lump against all obstacles.
  void look_around(const ScreenLump& lump, const Gaps& gaps, float farthest) {
    PlacedLump placed(tables_, lump, frames_[lump.frame]);
    const Vec& centre = placed.centre;
    const float around = lump.ball + farthest;
    const float lower[3] = {least_of(centre.x) - around, least_of(centre.y) - around, least_of(centre.z) - around};
    const float upper[3] = {greatest_of(centre.x) + around, greatest_of(centre.y) + around,
                            greatest_of(centre.z) + around};
    for (int first = 0; first < tables_.obstacle_count; first += kScreenLanes) {
      const ScreenBoxes& boxes = tables_.boxes[first / kScreenLanes];
      Mask beside = {0, 0, 0, 0, 0, 0, 0, 0};
      for (int i = 0; i < 3; ++i) beside |= (load(boxes.lower[i]) > upper[i]) | (load(boxes.upper[i]) < lower[i]);
      for (unsigned near = ~bits(beside) & 0xff; near != 0; near &= near - 1) {
        look_at(first + __builtin_ctz(near), placed, gaps);
        if (decided()) return;
      }
    }
  }

  void look_at(int index, PlacedLump& placed, const Gaps& gaps) {
    const ScreenShape& obstacle = tables_.obstacles[index];
    const ScreenLump& lump = placed.lump;
    if (lump.hand && obstacle.excused) return;
    if (bits(gap_to_ball(obstacle, seen_from(obstacle, placed.centre)) > gaps.most + lump.ball) == 0xff) return;
    for (int i = 0; i < placed.count && !decided(); ++i)
      meet(obstacle, placed.shapes[i], placed.pose(i), gaps, {lump.begin + i, index, true, 0});
  }

  // Two lumps. Seen from the frame of the one, its shapes stand still.
  void look_between(const ScreenMeeting& meeting) {
    const ScreenLump &one = tables_.lumps[meeting.one], &other = tables_.lumps[meeting.other];
    const Frame &from = frames_[one.frame], &to = frames_[other.frame];
    const Vec a = point(from, one.middle), b = point(to, other.middle);
    const Vec way = {a.x - b.x, a.y - b.y, a.z - b.z};
    const float sum = one.ball + other.ball + tables_.slack;
    if (bits(dot(way, way) > sum * sum) == 0xff) return;
    Frame between;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        between.r[3 * row + column] =
            from.r[row] * to.r[column] + from.r[3 + row] * to.r[3 + column] + from.r[6 + row] * to.r[6 + column];
    between.t = turned_back(from, {to.t.x - from.t.x, to.t.y - from.t.y, to.t.z - from.t.z});
    const Gaps gaps = {all(tables_.slack), all(-tables_.slack)};
    for (int k = other.begin; k < other.end; ++k) {
      Frame pose;
      compose(pose, between, tables_.shapes[k].turn, tables_.shapes[k].at);
      for (int i = one.begin; i < one.end; ++i) {
        meet(tables_.shapes[i], tables_.shapes[k], pose, gaps, {k, i, false, 0});
        if (decided()) return;
      }
    }
  }

  const ScreenTables& tables_;
  ScreenBatch& batch_;
  const bool any_;
  Frame frames_[kScreenJoints + 1];
  unsigned touching_ = 0;
};
