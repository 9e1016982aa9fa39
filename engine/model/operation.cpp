// Operations as bytes: a version, then the fields in their order; numbers little-endian, doubles bit for bit.
#include "engine/model/operation.h"

#include <bit>
#include <cstring>

#include "engine/base/enum_names.h"
#include "engine/base/error.h"
#include "engine/base/nearest.h"

namespace stampede {
namespace {

static_assert(std::endian::native == std::endian::little, "catalogues hold little-endian numbers");
constexpr std::uint8_t kVersion = 1;
constexpr std::array<std::string_view, 3> kControllers{"joint_position", "joint_impedance", "cartesian_impedance"};

class ByteWriter {
 public:
  template <typename Number>
  void number(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void vector(const JointVector& v) {
    number(static_cast<std::uint32_t>(v.size()));
    for (Eigen::Index i = 0; i < v.size(); ++i) number(v[i]);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  ByteReader(std::string_view kind, std::string_view bytes) : kind_(kind), bytes_(bytes) {}
  template <typename Number>
  Number number() {
    if (bytes_.size() < sizeof(Number)) fail("it ends too early");
    Number value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }
  JointVector vector() {
    const auto size = number<std::uint32_t>();
    if (size > 16) fail("it has more than 16 joints");
    JointVector v(static_cast<Eigen::Index>(size));
    for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = number<double>();
    return v;
  }
  std::size_t left() const { return bytes_.size(); }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("operation '" + kind_ + "'", what, "the catalogue is damaged or of another version");
  }

 private:
  std::string kind_;
  std::string_view bytes_;
};

struct Encoder {
  ByteWriter out;
  void operator()(const operation::Boundary&) {}
  void operator()(const operation::Controller& o) {
    out.number(static_cast<std::uint8_t>(o.kind));
    out.number(o.stiffness);
  }
  void operator()(const operation::Follow& o) {
    out.number(static_cast<std::uint64_t>(o.trajectory.knots.size()));
    for (const Trajectory::Knot& knot : o.trajectory.knots) {
      out.number(knot.step);
      out.vector(knot.position);
      out.vector(knot.velocity);
      out.vector(knot.acceleration);
    }
  }
  void operator()(const operation::Hand& o) {
    out.number(o.opening);
    out.number(o.force);
  }
  void operator()(const operation::Setpoint& o) {
    out.vector(o.position);
    out.vector(o.velocity);
  }
  void operator()(const operation::Servo& o) {
    out.number(static_cast<std::uint8_t>(o.of));
    out.vector(o.value);
  }
  void operator()(const operation::Place& o) {
    out.number(static_cast<std::int32_t>(o.body));
    for (int row = 0; row < 3; ++row)  // the matrix itself: a quaternion would not return the same bits
      for (int column = 0; column < 4; ++column) out.number(o.world_from_body.matrix()(row, column));
  }
};

Operation decode_follow(ByteReader& in) {
  operation::Follow o;
  const auto count = in.number<std::uint64_t>();
  if (count > in.left()) in.fail("its number of knots is impossible");
  for (std::uint64_t i = 0; i < count; ++i) {
    Trajectory::Knot knot;
    knot.step = in.number<std::int64_t>();
    knot.position = in.vector();
    knot.velocity = in.vector();
    knot.acceleration = in.vector();
    o.trajectory.knots.push_back(knot);
  }
  return o;
}

Operation decode_controller(ByteReader& in) {
  operation::Controller o;
  const auto kind = in.number<std::uint8_t>();
  if (kind > static_cast<std::uint8_t>(ControllerKind::cartesian_impedance)) in.fail("it names no controller");
  o.kind = static_cast<ControllerKind>(kind);
  o.stiffness = in.number<double>();
  return o;
}

Operation decode_servo(ByteReader& in) {
  operation::Servo o;
  const auto of = in.number<std::uint8_t>();
  if (of > static_cast<std::uint8_t>(operation::Servo::Of::passage)) in.fail("it names no quantity");
  o.of = static_cast<operation::Servo::Of>(of);
  o.value = in.vector();
  return o;
}

Operation decode(std::string_view kind, ByteReader& in) {
  if (kind == "boundary") return operation::Boundary{};
  if (kind == "controller") return decode_controller(in);
  if (kind == "follow") return decode_follow(in);
  if (kind == "hand") {
    const double opening = in.number<double>();
    return operation::Hand{opening, in.number<double>()};
  }
  if (kind == "setpoint") {
    JointVector position = in.vector();
    return operation::Setpoint{std::move(position), in.vector()};
  }
  if (kind == "servo") return decode_servo(in);
  if (kind == "place") {
    operation::Place o;
    o.body = in.number<std::int32_t>();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) o.world_from_body.matrix()(row, column) = in.number<double>();
    return o;
  }
  in.fail("there is no such operation");
}

}  // namespace

std::string_view operation_kind(const Operation& operation) {
  constexpr std::string_view kNames[] = {"boundary", "controller", "follow", "hand", "setpoint", "place", "servo"};
  static_assert(std::size(kNames) == std::variant_size_v<Operation>);
  return kNames[operation.index()];
}

std::optional<int> robot_of(const Operation& operation) {
  return std::visit(
      [](const auto& one) -> std::optional<int> {
        if constexpr (requires { one.robot; }) return one.robot;
        return std::nullopt;
      },
      operation);
}

void set_robot(Operation& operation, int robot) {
  std::visit(
      [robot](auto& one) {
        if constexpr (requires { one.robot; }) one.robot = robot;
      },
      operation);
}

std::string operation_to_bytes(const Operation& operation) {
  Encoder encoder;
  encoder.out.number(kVersion);
  std::visit(encoder, operation);
  return encoder.out.take();
}

Operation operation_from_bytes(std::string_view kind, std::string_view bytes) {
  ByteReader in(kind, bytes);
  if (in.number<std::uint8_t>() != kVersion) in.fail("it was written by another version");
  Operation operation = decode(kind, in);
  if (in.left() != 0) in.fail("it has " + std::to_string(in.left()) + " bytes too many");
  return operation;
}

std::string_view to_string(ControllerKind kind) { return enum_name(kControllers, kind); }
std::optional<ControllerKind> controller_from(std::string_view name) {
  return enum_from<ControllerKind>(kControllers, name);
}
std::vector<std::string> controller_names() { return {kControllers.begin(), kControllers.end()}; }

void check_controller(std::string_view name, const std::string& place) {
  if (controller_from(name)) return;
  throw Error(place, "there is no controller '" + std::string(name) + "'", did_you_mean(name, controller_names()));
}

}  // namespace stampede
