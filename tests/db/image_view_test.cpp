// What SQL can ask about cameras, pictures and masks.
#include <catch2/catch.hpp>
#include <cmath>

#include "db/table_text.h"
#include "engine/model/camera.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

struct Seen {
  Folder folder;
  EpisodeRecord episode = sample_episode("lift", "colour=red", 1);
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  Seen() {
    episode.images = sample_images(episode, {0, 3, 6, 11}, {"rgb", "depth"}, 1500);
    catalogue.add(episode, kEngine);
  }
  double number(const std::string& sql) const {
    const QueryResult result = catalogue.query(sql);
    REQUIRE(result.rows.size() == 1);
    return std::get<double>(result.rows[0][0]);
  }
  std::string text(const std::string& sql) const { return to_csv(catalogue.query(sql)); }
};

}  // namespace

TEST_CASE("the numbers of masks are named, and objects know their own") {
  const Seen seen;
  CHECK(seen.text("SELECT instance, name, object, class, semantic, colour FROM masks") ==
        "instance,name,object,class,semantic,colour\n1,panda.link0,panda,panda,3,\n"
        "2,panda.link1,panda.hand,hand,2,\n3,block2,block2,cube,1,blue\n4,block1,block1,cube,1,red\n");
  CHECK(seen.text("SELECT object, mask_id FROM objects") == "object,mask_id\nblock1,4\nblock2,3\n");
  EpisodeRecord hidden = sample_episode("lift", "colour=red", 2);
  Object region;
  region.name = "goal", region.kind = ObjectKind::region, region.class_name = region.type = "region";
  hidden.scene.objects.push_back(region);
  Catalogue other = Catalogue::write(seen.folder / "b.db");
  other.add(hidden, kEngine);
  CHECK(to_csv(other.query("SELECT mask_id FROM objects WHERE object = 'goal'")) == "mask_id\n0\n");
  CHECK_THAT(seen.text("mask_key"), Contains("1,4,block1,block1,cube,1,red\n"));
}

TEST_CASE("cameras say how they see and what they hang on") {
  const Seen seen;
  CHECK(seen.text("SELECT camera, width, height, mount FROM cameras") ==
        "camera,width,height,mount\nfront,128,128,world\nwrist,160,120,panda.link1\n");
  CHECK(seen.number("SELECT vertical_fov_rad FROM cameras WHERE camera = 'wrist'") == Approx(1.2));
  CHECK(seen.number("SELECT focal_y FROM cameras WHERE camera = 'wrist'") == Approx(60 / std::tan(0.6)));
  CHECK(seen.number("SELECT k2 FROM cameras WHERE camera = 'wrist'") == -0.2);
  CHECK(seen.number("SELECT z FROM cameras WHERE camera = 'wrist'") == 0.1);
  const Pose pose = to_pose(seen.episode.scene.cameras[1].mount_from_camera);
  CHECK(seen.number("SELECT qz FROM cameras WHERE camera = 'wrist'") == pose.quaternion[2]);
  CHECK(seen.number("SELECT x FROM cameras WHERE camera = 'front'") == 1);
}

TEST_CASE("a camera on furniture is named by the object of that part") {
  const Folder folder;
  EpisodeRecord e = sample_episode("lift", "colour=red", 1);
  Object chest;
  chest.name = chest.body = "chest", chest.class_name = chest.type = "chest";
  Object drawer = chest;
  drawer.name = "chest.drawer", drawer.kind = ObjectKind::part, drawer.part = 1;
  e.scene.objects.insert(e.scene.objects.end(), {chest, drawer});
  // Shuffled numbers: the mask of part 2 has the number that part 1 of a robot would have.
  e.scene.masks[1] = {2, "chest.door", "chest", "chest", 2};
  e.scene.cameras[0].mount_body = e.scene.cameras[1].mount_body = "chest";
  e.scene.cameras[0].mount_part = 0, e.scene.cameras[1].mount_part = 1;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(e, kEngine);
  CHECK(to_csv(catalogue.query("SELECT camera, mount FROM cameras")) ==
        "camera,mount\nfront,chest\nwrist,chest.drawer\n");
}

TEST_CASE("a picture of another size has the focal length of that size") {
  Seen seen;
  const Camera& wrist = seen.episode.scene.cameras[1];
  ImageStore images;
  images.append({1, 0, "rgb", 500, 300}, {1, 2});
  seen.catalogue.add_images(1, images, {{wrist, {}}});
  const Camera larger = resized(wrist, 500, 300);
  const auto value = [&](const std::string& column) {
    return seen.number("SELECT " + column + " FROM images WHERE frame = 1");
  };
  CHECK(value("focal_x") == Approx(larger.focal_x));
  CHECK(value("focal_y") == Approx(larger.focal_y));
  CHECK(value("centre_x") == Approx(larger.centre_x));
  CHECK(value("centre_y") == Approx(larger.centre_y));
  CHECK(seen.text("SELECT camera, time_s, width, bytes, data FROM images WHERE frame = 1") ==
        "camera,time_s,width,bytes,data\nwrist,0.05,500,2,0102\n");
}

TEST_CASE("images_by_episode counts pictures and bytes") {
  const Seen seen;  // 4 frames of 2 cameras and 2 kinds, 1500 bytes each
  CHECK(seen.text("images_by_episode") ==
        "episode,task,camera,kind,pictures,size,kb,kb_a_frame\n1,lift,front,depth,4,128x128,6.0,1.5\n"
        "1,lift,front,rgb,4,128x128,6.0,1.5\n1,lift,wrist,depth,4,160x120,6.0,1.5\n"
        "1,lift,wrist,rgb,4,160x120,6.0,1.5\n");
}

TEST_CASE("keyframe_images shows each skill's start and end") {
  const Seen seen;  // pick runs over frames 0 … 6, wait over 6 … 11
  const std::string answer = seen.text("SELECT skill, moment, frame FROM (" + [] {
    std::string sql = find_named_query("keyframe_images")->sql;
    return sql.substr(0, sql.find_last_of(';'));
  }() + ") WHERE camera = 'wrist'");
  CHECK(answer == "skill,moment,frame\npick,start,0\npick,end,6\nwait,start,6\nwait,end,11\n");
  CHECK_THAT(seen.text("keyframe_images"), Contains("pick up the \"\"red\"\" block\",end,6,0.3,front,128,128,1500\n"));
}
