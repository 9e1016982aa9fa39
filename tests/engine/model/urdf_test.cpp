#include "engine/model/urdf.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "engine/base/error.h"
#include "engine/geometry/mesh.h"

using namespace stampede;

namespace {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "stampede_urdf_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

const std::string kMass =
    "<inertial><origin xyz='0 0 0.1' rpy='0 0 1.5707963267948966'/><mass value='2'/>"
    "<inertia ixx='1' ixy='0' ixz='0' iyy='2' iyz='0' izz='2.5'/></inertial>";

std::string link_of(const std::string& name, const std::string& inside = kMass) {
  return "<link name='" + name + "'>" + inside + "</link>";
}

std::string joint_of(const std::string& name, const std::string& parent, const std::string& child,
                     const std::string& type = "revolute",
                     const std::string& inside = "<limit lower='-1' upper='2' effort='3' velocity='4'/>") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
         "'/><axis xyz='0 0 2'/>" + inside + "</joint>";
}

std::string robot(const std::string& inside) { return "<robot name='arm'>\n" + inside + "\n</robot>"; }

std::string urdf_complaint(const std::string& text) {
  const TemporaryFolder folder;
  try {
    (void)read_urdf(folder.write("bad.urdf", text));
  } catch (const Error& error) {
    CHECK(error.where().find("bad.urdf") != std::string::npos);
    CHECK_FALSE(error.hint().empty());
    return error.where() + ": " + error.message();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("links become parts, depth first, with all that a joint says") {
  const TemporaryFolder folder;
  const Body body =
      read_urdf(
          folder.write(
              "arm.urdf",
              robot("<material name='red'><color rgba='1 0 0 0.5'/></material>" + link_of("base", "") +
                    link_of("turn") +
                    link_of("tool",
                            "<visual><geometry><sphere radius='0.1'/></geometry><material name='red'/></visual>"
                            "<collision><geometry><box size='1 2 3'/></geometry></collision>") +
                    link_of("slide",
                            kMass + "<collision><geometry><cylinder radius='0.1' length='2'/></geometry></collision>") +
                    joint_of(
                        "a", "base", "turn", "revolute",
                        "<limit lower='-1' upper='2' effort='3' velocity='4'/><dynamics damping='5' friction='6'/>") +
                    joint_of("b", "turn", "tool", "fixed", "<origin xyz='0 0 1'/>") +
                    joint_of("c", "base", "slide", "prismatic",
                             "<limit lower='0.5' upper='1' effort='1' velocity='1'/><mimic joint='a'/>"))))
          .body;
  REQUIRE(body.parts.size() == 4);
  CHECK(body.name == "arm");
  CHECK(body.parts[2].name == "tool");
  CHECK(body.parts[2].parent == 1);
  CHECK(body.parts[3].parent == 0);
  const Joint& turn = body.parts[1].joint;
  CHECK(turn.kind == JointKind::hinge);
  CHECK(turn.axis == Vector3(0, 0, 1));
  CHECK(std::array{turn.lower, turn.upper, turn.effort, turn.velocity, turn.damping, turn.friction} ==
        std::array{-1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  CHECK(body.parts[3].joint.initial == 0.5);  // 0 is outside its limits
  // A quarter turn of the inertial frame about z swaps xx and yy.
  CHECK((body.parts[1].inertia.diagonal() - Vector3(2, 1, 2.5)).norm() < 1e-9);
  CHECK(body.parts[1].centre_of_mass == Vector3(0, 0, 0.1));
  REQUIRE(body.parts[2].shapes.size() == 2);
  CHECK((body.parts[2].shapes[0].collides && !body.parts[2].shapes[0].visible));
  CHECK((!body.parts[2].shapes[1].collides && body.parts[2].shapes[1].visible));
  CHECK(body.parts[2].shapes[1].colour.alpha == Approx(0.5));
  CHECK((body.parts[3].shapes[0].collides && body.parts[3].shapes[0].visible));  // no visual: shown as it collides
}

TEST_CASE("a mesh becomes a hull, found beside the URDF") {
  const TemporaryFolder folder;
  folder.write("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const Body body =
      read_urdf(
          folder.write("arm.urdf",
                       robot(link_of("base",
                                     "<collision><geometry><mesh filename='package://any/tetra.obj' scale='2 2 2'/>"
                                     "</geometry></collision>"))))
          .body;
  REQUIRE(body.parts[0].shapes.size() == 2);  // as it collides, and as it is drawn
  CHECK(body.parts[0].shapes[0].kind == ShapeKind::hull);
  CHECK(body.parts[0].shapes[1].kind == ShapeKind::mesh);
  CHECK(bounding_box(body.parts[0])[1] == Vector3(2, 2, 2));
}

TEST_CASE("visual meshes are drawn as they are, in the material's looks or else the file's") {
  const TemporaryFolder folder;
  const std::string tetra = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  folder.write("leaf.mtl", "newmtl leaf\nKd 0 1 0\n");
  folder.write("leaf.obj", "mtllib leaf.mtl\nusemtl leaf\n" + tetra);
  const std::string mesh = "<geometry><mesh filename='leaf.obj'/></geometry>";
  const UrdfBody urdf = read_urdf(folder.write(
      "arm.urdf", robot("<material name='red'><color rgba='1 0 0 1'/></material>" +
                        link_of("base", "<visual>" + mesh + "</visual><visual>" + mesh +
                                            "<material name='red'/></visual><collision>" + mesh + "</collision>"))));
  const std::vector<Shape>& shapes = urdf.body.parts[0].shapes;
  REQUIRE(shapes.size() == 3);
  CHECK((shapes[0].kind == ShapeKind::hull && shapes[0].collides && !shapes[0].visible));
  for (const int i : {1, 2}) {
    const Shape& drawn = shapes[static_cast<std::size_t>(i)];
    CHECK((drawn.kind == ShapeKind::mesh && !drawn.collides && drawn.visible));
    CHECK(urdf.drawn.meshes.at(drawn.mesh)->triangles.size() == 4);
  }
  CHECK(shapes[1].colour.green == 1.0);
  CHECK(shapes[2].colour.red == 1.0);
  CHECK(urdf.drawn.meshes.size() == 1);  // the same mesh twice
}

TEST_CASE("equal meshes and textures have equal keys, others do not") {
  DrawnAssets assets;
  DrawnMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  const std::string one = assets.add(std::make_shared<const DrawnMesh>(mesh));
  CHECK(assets.add(std::make_shared<const DrawnMesh>(mesh)) == one);
  mesh.positions[1][0] = 2;
  CHECK(assets.add(std::make_shared<const DrawnMesh>(mesh)) != one);
  CHECK(assets.meshes.size() == 2);
  Texture texture;
  texture.kind = TextureKind::checker;
  const std::string checker = assets.add("checker", texture);
  CHECK(assets.add("checker", texture) == checker);
  texture.size_m = 0.2;
  CHECK(assets.add("checker", texture) != checker);
  DrawnAssets others;
  others.add("checker", texture);
  others.join(assets);
  CHECK(others.textures.size() == 2);
  CHECK(others.meshes.size() == 2);
}

TEST_CASE("bad URDF files say where and what") {
  using Catch::Contains;
  CHECK_THAT(urdf_complaint("<robot name='arm'>\n<link name='a'>\n</robot>"),
             Contains("bad.urdf:3") && Contains("malformed"));
  CHECK_THAT(urdf_complaint(""), Contains("malformed") || Contains("robot"));
  CHECK_THAT(urdf_complaint("<sdf/>"), Contains("robot"));
  CHECK_THAT(urdf_complaint(robot(link_of("a") + joint_of("j", "a", "b"))), Contains("'b'") || Contains("[b]"));
  CHECK_THAT(urdf_complaint(robot(link_of("a") + link_of("a"))), Contains("a") && Contains("not unique"));
  CHECK_THAT(urdf_complaint(robot(link_of("a") + link_of("b") + joint_of("j", "a", "b") + joint_of("k", "b", "a"))),
             Contains("root"));
  CHECK_THAT(urdf_complaint(robot(link_of("r") + link_of("a") + link_of("b") + joint_of("i", "r", "a") +
                                  joint_of("j", "a", "b") + joint_of("k", "b", "a"))),
             Contains("two parents or lies on a cycle"));
  CHECK_THAT(urdf_complaint(
                 robot(link_of("r") + link_of("a") + link_of("b") + joint_of("j", "a", "b") + joint_of("k", "b", "a"))),
             Contains("link 'a'") && Contains("does not hang on"));
  CHECK_THAT(
      urdf_complaint(robot(link_of("a", "<collision><geometry><mesh filename='gone.stl'/></geometry></collision>"))),
      Contains("link 'a'") && Contains("gone.stl") && Contains("no such mesh"));
  CHECK_THAT(urdf_complaint(robot(link_of("a", "<visual><geometry><mesh filename='gone.stl'/></geometry></visual>"))),
             Contains("link 'a'") && Contains("mesh") && Contains("gone.stl"));
  CHECK_THAT(urdf_complaint(robot("<material name='wood'><texture filename='gone.png'/></material>" +
                                  link_of("a",
                                          "<visual><geometry><box size='1 1 1'/></geometry><material "
                                          "name='wood'/></visual>"))),
             Contains("link 'a'") && Contains("texture") && Contains("gone.png"));
  CHECK_THAT(urdf_complaint(robot(link_of("a") + link_of("b") + joint_of("j", "a", "b", "floating", ""))),
             Contains("joint 'j'") && Contains("floating"));
  CHECK_THAT(urdf_complaint(robot(link_of("a", "<collision><geometry><box size='1 -1 1'/></geometry></collision>"))),
             Contains("link 'a'") && Contains("box"));
  CHECK_THAT(urdf_complaint(robot(link_of("a", "<collision><geometry><torus/></geometry></collision>"))),
             Contains("torus"));
  CHECK_THAT(urdf_complaint(
                 robot(link_of("a") + link_of("b") +
                       joint_of("j", "a", "b", "revolute", "<limit lower='2' upper='1' effort='1' velocity='1'/>"))),
             Contains("joint 'j'") && Contains("lower limit"));
  CHECK_THROWS_AS(read_urdf("/nowhere/arm.urdf"), Error);
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder.write("a", "").parent_path() / "pipe.urdf";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH(read_urdf(pipe), Contains("it is no file"));
}

namespace {

std::string inertial(const std::string& mass, const std::string& xx, const std::string& yy, const std::string& zz) {
  return "<inertial><mass value='" + mass + "'/><inertia ixx='" + xx + "' ixy='0' ixz='0' iyy='" + yy +
         "' iyz='0' izz='" + zz + "'/></inertial>";
}
const std::string kBlock = "<collision><geometry><box size='0.1 0.2 0.3'/></geometry></collision>";

std::string texts(const std::vector<Error>& remarks) {
  std::string all;
  for (const Error& remark : remarks) all += remark.message() + "\n";
  return all;
}

}  // namespace

TEST_CASE("inertias as exporters write them are worked out from mass and shape, with a remark that names the link") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const auto read = [&](const std::string& inside, const std::string& type = "revolute") {
    return read_urdf(
        folder.write("e.urdf", robot(link_of("a") + link_of("b", inside) + joint_of("j", "a", "b", type))));
  };
  const double m = 2, xx = m * (0.04 + 0.09) / 12, zz = m * (0.01 + 0.04) / 12;
  for (const std::string& one :
       {inertial("2", "0", "0", "0"), inertial("2", "1", "1", "0"), inertial("2", "1", "1", "-1"),
        inertial("2", "1", "1", "5"), std::string("<inertial><mass value='2'/></inertial>")}) {
    const UrdfBody urdf = read(one + kBlock);
    CAPTURE(one, texts(urdf.remarks));
    CHECK(urdf.body.parts[1].mass == 2);
    CHECK(urdf.body.parts[1].inertia(0, 0) == Approx(xx));
    CHECK(urdf.body.parts[1].inertia(2, 2) == Approx(zz));
    CHECK_THAT(texts(urdf.remarks), Contains("link 'b': no solid has its inertia: it is worked out from its 2 kg"));
  }
  for (const std::string& one : {std::string(), inertial("0", "0", "0", "0"), std::string("<inertial/>")}) {
    const UrdfBody urdf = read(one + kBlock);
    CAPTURE(one, texts(urdf.remarks));
    CHECK(urdf.body.parts[1].mass == Approx(500 * 0.006));
    CHECK_THAT(texts(urdf.remarks), Contains("link 'b': it moves and has no mass: 3 kg are taken, from its shapes"));
  }
  const UrdfBody frame = read("");
  CHECK(frame.body.parts[1].mass == 0.01);
  CHECK_THAT(texts(frame.remarks), Contains("as it has no solid shape"));
  CHECK(read(inertial("2", "1", "2", "3.2") + kBlock).remarks.empty());  // measured, or rounded
  CHECK(read(inertial("0", "0", "0", "0"), "fixed").remarks.empty());    // a flange
  const UrdfBody still = read(inertial("2", "0", "0", "0") + kBlock, "fixed");
  CHECK_THAT(texts(still.remarks), Contains("which is ignored: it cannot move"));
  CHECK(read("", "fixed").body.parts[1].mass == 0);
  for (const std::string& one :
       {inertial("-1", "1", "1", "1"), inertial("nan", "1", "1", "1"), inertial("1", "inf", "1", "1")})
    CHECK_THAT(urdf_complaint(robot(link_of("a") + link_of("b", one) + joint_of("j", "a", "b"))), Contains("bad.urdf"));
}

TEST_CASE("meshes of packages are found above the URDF, inside the roots only") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const std::string tetra = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const auto put = [&](const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder.write("x", "").parent_path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path;
  };
  const std::filesystem::path root = folder.write("x", "").parent_path();
  const auto reads = [&](const std::string& urdf, const std::string& mesh) {
    const auto file =
        put(urdf, robot(link_of("a", "<collision><geometry><mesh filename='" + mesh + "'/></geometry></collision>")));
    try {
      return std::to_string(read_urdf(file, FileScope({root})).body.parts[0].shapes.size());
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  put("arm_description/meshes/visual/a b.obj", tetra);
  CHECK(reads("arm_description/urdf/arm.urdf", "package://arm_description/meshes/visual/a b.obj") == "2");
  CHECK_THAT(reads("arm_description/urdf/arm.urdf", "../meshes/visual/a%20b.obj"), Contains("has a '%'"));
  CHECK(reads("arm_description/urdf/arm.urdf", "..\\meshes\\visual\\a b.obj") == "2");
  CHECK(reads("arm_description/urdf/arm.urdf", "file://" + (root / "arm_description/meshes/visual/a b.obj").string()) ==
        "2");
  CHECK(reads("arm_description/urdf/arm.urdf", "package://other/meshes/visual/a b.obj") ==
        "2");  // urdf/ beside meshes/
  put("ros/hand/package.xml", "<package><name> hand_model </name></package>");
  put("ros/hand/m/h.obj", tetra);
  CHECK(reads("ros/hand/deep/down/h.urdf", "package://hand_model/m/h.obj") == "2");
  CHECK(reads("ros/arm/urdf/a.urdf", "package://hand/m/h.obj") == "2");  // a package beside
  CHECK_THAT(
      reads("ros/arm/urdf/a.urdf", "package://hand/m/gone.obj"),
      Contains("link 'a'") && Contains("package 'hand'") && Contains("m/gone.obj") && Contains("inside the roots"));
  CHECK_THAT(reads("ros/arm/urdf/a.urdf", "package://hand"), Contains("names no file of a package"));
  CHECK_THAT(reads("ros/arm/urdf/a.urdf", "https://host/h.obj"), Contains("'https://' are not fetched"));
  CHECK_THAT(reads("ros/arm/urdf/a.urdf", "file:///etc/hosts.obj"), Contains("outside the roots"));
  CHECK_THAT(reads("ros/arm/urdf/a.urdf", "package://hand/../../../../../../../../etc/passwd"), Contains("outside"));
}

TEST_CASE("a DAE whose y axis is up says so, and is read as it is written") {
  const TemporaryFolder folder;
  for (const std::string axis : {"Y_UP", "X_UP"})
    CHECK(mesh_remark(folder.write("a.dae", "<COLLADA><asset><up_axis>" + axis + "</up_axis></asset></COLLADA>"))
              .find("which is ignored as by ROS") != std::string::npos);
  CHECK(mesh_remark(folder.write("a.dae", "<COLLADA><asset><up_axis>Z_UP</up_axis></asset></COLLADA>")).empty());
  CHECK(mesh_remark(folder.write("a.obj", "<up_axis>Y_UP")).empty());
}

TEST_CASE("a URDF is no format, and has its limits") {
  using Catch::Contains;
  const std::string format = "%s%s%s%s%n";
  for (const std::string& text :
       {robot(link_of("a", "<inertial><mass value='" + format + "'/></inertial>")), robot(link_of(format)),
        robot(link_of("a", "<inertial><mass value='&#37;n&#x25;n'/></inertial>")),
        robot(link_of("a", "<visual><geometry><" + format + "/></geometry></visual>")),
        "<robot name='" + format + "'>" + link_of("a") + "</robot>"})
    CHECK_THAT(urdf_complaint(text), Contains("'%'") || Contains("malformed"));
  CHECK(urdf_complaint(robot("<!-- 100 % --><gazebo>50 %s</gazebo>" + link_of("a"))) == "accepted");
  CHECK(urdf_complaint(robot(link_of("a"))) == "accepted");

  std::string many = "<link name='l0'/>", deep;
  for (int i = 1; i <= 1000; ++i) {
    const std::string own = std::to_string(i), before = std::to_string(i - 1);
    many += "<link name='l" + own + "'/><joint name='j" + own + "' type='fixed'><parent link='l" + before +
            "'/><child link='l" + own + "'/></joint>";
  }
  CHECK_THAT(urdf_complaint(robot(many)), Contains("1001 links") && Contains("1000"));
  for (int i = 0; i < 60'000; ++i) deep += "<a>";
  CHECK_THAT(urdf_complaint(deep), Contains("60000 XML elements"));
  CHECK_THAT(urdf_complaint(deep.substr(0, 3 * 9'999)), Contains("malformed"));  // deep, but not too deep to say so
}

TEST_CASE("what a URDF names lies in its folder, or in the scope") {
  using Catch::Contains;
  const TemporaryFolder folder, elsewhere;
  const auto mesh =
      elsewhere.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const auto named = [&](const std::string& name) {
    return folder.write("arm.urdf", robot(link_of("a", kMass + "<collision><geometry><mesh filename='" + name +
                                                           "'/></geometry></collision>")));
  };
  for (const std::string& name : {mesh.string(), "file://" + mesh.string(),
                                  "package://arm/../" + mesh.parent_path().filename().string() + "/m.obj",
                                  "../" + mesh.parent_path().filename().string() + "/m.obj"}) {
    CAPTURE(name);
    const auto file = named(name);
    CHECK_THROWS_WITH(read_urdf(file), Contains("link 'a'") && Contains("outside the roots") && Contains("--path"));
    CHECK(read_urdf(file, FileScope({folder.write("x", "").parent_path(), mesh.parent_path()})).body.parts.size() == 1);
  }
}
