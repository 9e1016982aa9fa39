// Pictures made while an episode ran, and later: the same bytes, however they are asked for.
#include <atomic>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <span>

#include "db/catalogue.h"
#include "engine/render/png.h"
#include "tests/program/film.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

constexpr const char* kReach = "reach_target";

Said run_into(const std::string& file, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"run", kReach, "--root", kRoot, "--out", file};
  words.insert(words.end(), more.begin(), more.end());
  const Said said = say(words);
  INFO(said.err);
  REQUIRE(said.code == kDone);
  return said;
}

Said render(std::vector<std::string> words, const std::string& root = kRoot) {
  words.insert(words.begin(), "render");
  words.insert(words.end(), {"--root", root});
  return say(words);
}

// Every stored picture, by the name that a person would give it.
std::map<std::string, std::vector<std::uint8_t>> images_of(const std::string& file) {
  const Catalogue catalogue = Catalogue::open(file);
  std::map<std::string, std::vector<std::uint8_t>> images;
  for (const EpisodeSummary& episode : catalogue.episodes())
    for (const ImageEntry& image : catalogue.images(episode.id))
      images[episode.variation + " " + std::to_string(episode.seed) + " " + std::to_string(image.frame) + " " +
             image.camera + " " + image.kind] = catalogue.read_image(episode.id, image.frame, image.camera, image.kind);
  return images;
}

// All of `some` are in `all`, with the same bytes.
void check_subset(const std::map<std::string, std::vector<std::uint8_t>>& some,
                  const std::map<std::string, std::vector<std::uint8_t>>& all) {
  REQUIRE_FALSE(some.empty());
  for (const auto& [name, bytes] : some) {
    INFO(name);
    REQUIRE(all.contains(name));
    CHECK(all.at(name) == bytes);
  }
}

// Presses Ctrl-C when the first episode has been told, while another thread draws the next.
class StopAtFlush : public std::stringbuf {
 public:
  explicit StopAtFlush(std::atomic<bool>& stop) : stop_(stop) {}

 private:
  int sync() override {
    stop_ = true;
    return 0;
  }
  std::atomic<bool>& stop_;
};

const std::vector<std::string> kSmall = {"--size", "48x40"};

std::vector<std::string> small(std::vector<std::string> words) {
  words.insert(words.end(), kSmall.begin(), kSmall.end());
  return words;
}

}  // namespace

TEST_CASE("pictures rendered later are those that the run would have stored, byte for byte") {
  const Folder folder;
  for (const std::vector<std::string>& look :
       {std::vector<std::string>{}, {"--noise", "rgb=0.03,depth=kinect", "--shadows", "--kinds", "rgb,depth,points"}}) {
    const std::string now = folder / ("now" + std::to_string(look.size()) + ".db");
    const std::string later = folder / ("later" + std::to_string(look.size()) + ".db");
    std::vector<std::string> with = small(look);
    with.insert(with.end(), {"--episodes", "2", "--images", "all"});
    run_into(now, with);
    with.back() = "none";  // the rest of the wishes is stored with the episode
    run_into(later, with);
    CHECK(images_of(later).empty());
    const Said said = render({later, "--into", later}, folder.text());  // no scripts there
    INFO(said.out + said.err);
    REQUIRE(said.code == kDone);
    CHECK(said.err.empty());
    CHECK(images_of(later) == images_of(now));
    CHECK(images_of(later).size() % (look.empty() ? 4 : 3) == 0);
    // Again: nothing to add, and nothing is lost.
    CHECK(says(render({later, "--into", later}).out, "were there already"));
    CHECK(images_of(later) == images_of(now));
    CHECK(say({"replay", later}).code == kDone);
  }
}

TEST_CASE("OSMesa draws when asked: nearly our pictures, and the episode says who drew them") {
  const Folder folder;
  const std::vector<std::string> wanted = {"--images", "keyframes", "--camera", "front", "--kinds", "rgb,instance"};
  run_into(folder / "own.db", wanted);
  std::vector<std::string> by_mesa = wanted;
  by_mesa.insert(by_mesa.end(), {"--renderer", "osmesa"});
  run_into(folder / "mesa.db", by_mesa);
  const auto own = images_of(folder / "own.db"), mesa = images_of(folder / "mesa.db");
  REQUIRE(own.size() == mesa.size());
  CHECK(own != mesa);
  int other_ids = 0, other_colours = 0, pixels = 0;
  for (const auto& [name, bytes] : own) {
    const PictureKind kind = name.ends_with("rgb") ? PictureKind::rgb : PictureKind::instance;
    Picture a, b;
    from_png(bytes, kind, a);
    from_png(mesa.at(name), kind, b);
    pixels += kind == PictureKind::rgb ? a.width * a.height : 0;
    for (std::size_t i = 0; i < a.instance.size(); ++i) other_ids += a.instance[i] != b.instance[i];
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) other_colours += std::abs(a.rgb[i] - b.rgb[i]) > 6;
  }
  CHECK(other_ids * 100 < pixels);
  CHECK(other_colours * 50 < pixels);
  CHECK(says(say({"query", folder / "mesa.db", "SELECT options FROM episodes", "--format", "csv"}).out, "osmesa"));
  // Without further words as the run drew them, with --renderer own as ours.
  const auto drawn = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {folder / "mesa.db", "--frames", "0", "--out", folder / out});
    REQUIRE(render(more).code == kDone);
    return file_text(folder / (out + "/episode_000001/front/rgb/000000.png"));
  };
  const auto text = [](const std::vector<std::uint8_t>& bytes) { return std::string(bytes.begin(), bytes.end()); };
  const std::string first = mesa.begin()->first.substr(0, mesa.begin()->first.find(" 0 ")) + " 0 0 front rgb";
  CHECK(drawn("again", {}) == text(mesa.at(first)));
  CHECK(drawn("ours", {"--renderer", "own"}) == text(own.at(first)));
}

TEST_CASE("keyframes, one camera, some frames and two workers give pictures of the full set") {
  const Folder folder;
  const std::vector<std::string> noisy = small({"--episodes", "2", "--noise", "rgb=0.02,depth=kinect"});
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), noisy.begin(), noisy.end());
    return more;
  };
  run_into(folder / "all.db", with({"--images", "all"}));
  const auto all = images_of(folder / "all.db");
  run_into(folder / "two.db", with({"--images", "all", "--workers", "2"}));
  CHECK(images_of(folder / "two.db") == all);
  run_into(folder / "key.db", with({"--images", "keyframes"}));
  const auto keyframes = images_of(folder / "key.db");
  check_subset(keyframes, all);
  CHECK(keyframes.size() < all.size());
  run_into(folder / "one.db", with({"--images", "all", "--camera", "front"}));
  const auto front = images_of(folder / "one.db");
  check_subset(front, all);
  for (const auto& [name, bytes] : front) CHECK(says(name, " front "));

  // The same from a catalogue without any.
  run_into(folder / "bare.db", noisy);
  REQUIRE(render({folder / "bare.db", "--into", folder / "bare.db", "--frames", "0,3-5", "--camera", "front",
                  "--workers", "2"})
              .code == kDone);
  const auto some = images_of(folder / "bare.db");
  CHECK(some.size() == 2 * 4 * 4);  // episodes, frames, kinds
  check_subset(some, all);
  REQUIRE(render({folder / "bare.db", "--into", folder / "bare.db", "--workers", "2"}).code == kDone);
  CHECK(images_of(folder / "bare.db") == all);
}

TEST_CASE("files: a PNG a picture, a PLY a cloud, and what the numbers mean") {
  const Folder folder;
  run_into(folder / "d.db");
  const Said said = render({folder / "d.db", "--camera", "front", "--size", "64x48", "--kinds", "rgb,depth,points",
                            "--frames", "2", "--out", folder / "out", "--json"});
  INFO(said.err);
  REQUIRE(said.code == kDone);
  CHECK(says(said.out, "\"pictures\": 3"));
  const std::string own = folder / "out/episode_000001/";
  Picture picture;
  const std::string rgb = file_text(own + "front/rgb/000002.png"), depth = file_text(own + "front/depth/000002.png");
  const auto bytes = [](const std::string& text) {
    return std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  };
  from_png(bytes(rgb), PictureKind::rgb, picture);
  from_png(bytes(depth), PictureKind::depth, picture);
  CHECK(picture.width == 64);
  CHECK(picture.height == 48);
  CHECK(picture.rgb.size() == 64 * 48 * 3);
  CHECK(file_text(own + "front/points/000002.ply").starts_with("ply\n"));
  CHECK_FALSE(std::filesystem::exists(own + "front/instance"));
  CHECK(says(file_text(own + "masks.csv"), "instance,name,object,class,semantic\n1,panda"));
  const std::string cameras = file_text(own + "cameras.csv");
  CHECK(std::count(cameras.begin(), cameras.end(), '\n') == 2);  // heading, one frame of one camera
  CHECK(says(cameras, "\n2,0.1,front,64,48,"));                  // frame 2 of 20 a second
}

TEST_CASE("cameras of the command line: drawn, named in the catalogue, and mounted where they were told") {
  const Folder folder;
  const std::string extra = "extra=at:0,-1,1.5;look:0.2,0,0.75;size:32x24;fov:60";
  const std::string hand = "eye=at:0.05,0,0;look:0.05,0,1;up:0,1,0;mount:panda.hand;size:16x16";
  run_into(folder / "d.db", {"--add-camera", extra, "--add-camera", hand, "--images", "keyframes", "--camera", "extra",
                             "--camera", "eye"});
  run_into(folder / "bare.db");
  const Said said = render({folder / "bare.db", "--into", folder / "bare.db", "--frames", "keyframes", "--camera",
                            "extra", "--camera", "eye", "--add-camera", extra, "--add-camera", hand});
  INFO(said.err);
  REQUIRE(said.code == kDone);
  CHECK(images_of(folder / "bare.db") == images_of(folder / "d.db"));
  // Once there, it has a name.
  CHECK(render({folder / "bare.db", "--camera", "eye", "--out", folder / "out"}).code == kDone);
}

TEST_CASE("a film and a contact sheet: as many pictures as frames, the band below, a block an episode") {
  const Folder folder;
  run_into(folder / "d.db", {"--episodes", "2"});
  const Said said = render({folder / "d.db", "1", "--video", folder / "f.mp4", "--size", "96x96"});
  INFO(said.err);
  REQUIRE(said.code == kDone);
  const auto frames = Catalogue::open(folder / "d.db").episodes().front().frames;
  const Film film = read_film(folder / "f.mp4");
  CHECK(static_cast<std::int64_t>(film.frames.size()) == frames);
  CHECK(film.frames.front().width == 96);
  CHECK(film.frames.front().height > 96);
  CHECK(film.duration_s == Approx(static_cast<double>(frames) / 20).margin(1e-6));

  const auto sheet = [&](const std::string& name, std::vector<std::string> which) {
    which.insert(which.begin(), folder / "d.db");
    which.insert(which.end(), {"--sheet", folder / name, "--size", "96x96"});
    REQUIRE(render(which).code == kDone);
    const std::string text = file_text(folder / name);
    Picture picture;
    from_png(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), PictureKind::rgb, picture);
    return picture;
  };
  const Picture one = sheet("one.png", {"1"}), both = sheet("both.png", {"1", "2", "--workers", "2"});
  CHECK(both.height > one.height);
  // The first block is that of the sheet of one.
  for (int y = 0; y < one.height; ++y) {
    const auto row = [y](const Picture& p) { return p.rgb.begin() + static_cast<std::ptrdiff_t>(y) * p.width * 3; };
    REQUIRE(std::equal(row(one), row(one) + static_cast<std::ptrdiff_t>(one.width) * 3, row(both)));
  }
}

TEST_CASE("scripts that changed since are named on one line, and the pictures are of what was stored") {
  const Folder folder, mine;
  std::filesystem::create_directories(mine / "tasks");
  const std::string source = file_text(std::filesystem::path(kRoot) / "tasks/reach_target.lua");
  std::ofstream(mine / "tasks/reach_target.lua") << source;
  const auto drawn = [&](const std::string& out) {
    return say({"render", folder / "d.db", "--root", kRoot, "--path", mine.text(), "--out", folder / out, "--frames",
                "0", "--camera", "front", "--kinds", "rgb"});
  };
  run_into(folder / "d.db", {"--path", mine.text()});
  CHECK(drawn("before").err.empty());
  std::ofstream(mine / "tasks/reach_target.lua") << "-- Another.\nreturn task { nonsense\n";
  const Said said = drawn("after");
  CHECK(said.code == kDone);
  CHECK(says(said.err, "scripts changed since 1 of the episodes ran (tasks/reach_target.lua)"));
  CHECK(std::count(said.err.begin(), said.err.end(), '\n') == 1);
  const std::string name = "/episode_000001/front/rgb/000000.png";
  CHECK(file_text(folder / ("before" + name)) == file_text(folder / ("after" + name)));
}

TEST_CASE("drawn looks are stored: later pictures wear them too") {
  const Folder folder;
  const std::vector<std::string> looks = small({"--randomise", "--camera", "front", "--kinds", "rgb"});
  const auto with = [&](const char* which) {
    std::vector<std::string> words = looks;
    words.insert(words.end(), {"--images", which});
    return words;
  };
  run_into(folder / "now.db", with("keyframes"));
  run_into(folder / "later.db", with("none"));
  run_into(folder / "plain.db", small({"--images", "keyframes", "--camera", "front", "--kinds", "rgb"}));
  REQUIRE(render({folder / "later.db", "--into", folder / "later.db", "--frames", "keyframes"}).code == kDone);
  CHECK(images_of(folder / "later.db") == images_of(folder / "now.db"));
  CHECK(images_of(folder / "plain.db").begin()->second != images_of(folder / "now.db").begin()->second);
  CHECK(say({"replay", folder / "now.db"}).code == kDone);
}

TEST_CASE("an episode that never started is left out with a line, the others are drawn") {
  const Folder folder, mine;
  std::filesystem::create_directories(mine / "tasks");
  std::ofstream(mine / "tasks/never.lua")
      << "-- Never starts.\nreturn task {\n  world = \"tabletop\",\n  objects = { cup = { \"cube\" } },\n"
         "  init = { is.on(\"cup\", \"table\"), is.holding(\"cup\") },\n  goal = { is.holding(\"cup\") },\n"
         "  instructions = { \"take it\" },\n}\n";
  REQUIRE(say({"run", "never", "--root", kRoot, "--path", mine.text(), "--out", folder / "d.db"}).code == kNo);
  const std::vector<std::string> words = {folder / "d.db", "--into", folder / "d.db", "--frames", "0"};
  CHECK(render(words).code == kNo);  // nothing at all was drawn
  run_into(folder / "d.db");
  const Said said = render(words);
  CHECK(said.code == kDone);
  CHECK(says(said.err, "episode 1 is left out: "));
  CHECK(Catalogue::open(folder / "d.db").images(1).empty());
  CHECK_FALSE(Catalogue::open(folder / "d.db").images(2).empty());
}

TEST_CASE("show says what pictures an episode has") {
  const Folder folder;
  run_into(folder / "d.db", {"--images", "keyframes", "--camera", "front", "--kinds", "rgb"});
  const auto count = images_of(folder / "d.db").size();
  CHECK(says(say({"show", folder / "d.db", "1"}).out, ", " + std::to_string(count) + " pictures of 1 camera, "));
}

TEST_CASE("Ctrl-C while rendering: no half episode, and the same command goes on") {
  const Folder folder;
  run_into(folder / "d.db", {"--episodes", "3"});
  std::atomic<bool> stop = false;
  StopAtFlush buffer(stop);
  std::ostream out(&buffer);
  std::ostringstream err;
  Console console{out, err, false, false, 100, &stop};
  const ExitCode code = run_program(
      all_commands(),
      {"render", folder / "d.db", "--into", folder / "d.db", "--size", "256x256", "--workers", "2", "--root", kRoot},
      console);
  INFO(err.str());
  CHECK(code == kInterrupted);
  CHECK(says(err.str(), "of 3 episodes are drawn"));
  const Catalogue catalogue = Catalogue::open(folder / "d.db");
  int with = 0;
  for (const EpisodeSummary& episode : catalogue.episodes()) {
    const auto images = catalogue.images(episode.id);
    std::set<std::int64_t> frames;
    for (const ImageEntry& image : images) frames.insert(image.frame);
    CHECK((images.empty() || static_cast<std::int64_t>(frames.size()) == episode.frames));
    with += images.empty() ? 0 : 1;
  }
  CHECK(with == 1);
  CHECK(render({folder / "d.db", "--into", folder / "d.db", "--size", "256x256"}).code == kDone);
}

}  // namespace stampede::program
