// The same pixels, whatever else is drawn, before or beside.
#include <catch2/catch.hpp>
#include <thread>

#include "tests/engine/render/all_shapes.h"

using namespace stampede;

namespace {

void demand_same(const Picture& a, const Picture& b) {
  CHECK(a.width == b.width);
  CHECK(a.height == b.height);
  CHECK(a.rgb == b.rgb);
  CHECK(a.depth == b.depth);
  CHECK(a.instance == b.instance);
  CHECK(a.semantic == b.semantic);
}

// The five cameras with sizes that share nothing, one of them distorted.
std::vector<View> odd_views(const Studio& studio) {
  std::vector<View> views = views_of(*studio.scene, studio.poses);
  constexpr std::array<std::array<int, 2>, 5> kSizes{{{128, 128}, {97, 61}, {1, 33}, {200, 127}, {65, 65}}};
  for (std::size_t i = 0; i < views.size(); ++i)
    views[i].camera = resized(views[i].camera, kSizes.at(i)[0], kSizes.at(i)[1]);
  views[3].camera.distortion = {-0.2, 0.05, 0.001, 0.001, 0};
  return views;
}

}  // namespace

TEST_CASE("A camera alone gives the pixels that it gives among five, in any order") {
  Studio studio(scene_with_five_cameras(10));
  const DrawOptions options{.kinds = {}, .shadows = GENERATE(false, true), .samples = GENERATE(1, 2)};
  std::vector<View> views = odd_views(studio);
  const std::vector<Picture> together = studio.draw(views, options);
  for (std::size_t i = 0; i < views.size(); ++i) demand_same(studio.draw(views[i], options), together[i]);
  std::reverse(views.begin(), views.end());
  const std::vector<Picture> backwards = studio.draw(views, options);
  for (std::size_t i = 0; i < views.size(); ++i) demand_same(backwards[i], together[views.size() - 1 - i]);
}

TEST_CASE("What was drawn and loaded before leaves no trace") {
  Studio fresh(scene_with_five_cameras(10)), used(all_shapes());
  const DrawOptions options{.kinds = {}, .shadows = true};
  used.draw(view_of_shapes(301, 40), options);
  used.draw(view_of_shapes(64, 64), {.kinds = {.rgb = false, .instance = false, .semantic = false}});
  used.renderer->load(fresh.scene);
  std::vector<Picture> after;
  const std::vector<View> views = odd_views(fresh);
  used.renderer->draw(fresh.poses, views, options, after);
  const std::vector<Picture> before = fresh.draw(views, options);
  for (std::size_t i = 0; i < views.size(); ++i) demand_same(after[i], before[i]);
}

TEST_CASE("Two renderers in two threads draw the same, at the same time") {
  const auto work = [](std::vector<Picture>& pictures) {
    Studio studio(scene_with_five_cameras(10));
    for (int i = 0; i < 20; ++i) pictures = studio.draw(odd_views(studio), {.kinds = {}, .shadows = true});
  };
  std::vector<Picture> here, there;
  std::thread other(work, std::ref(there));
  work(here);
  other.join();
  REQUIRE(here.size() == there.size());
  for (std::size_t i = 0; i < here.size(); ++i) demand_same(here[i], there[i]);
}

TEST_CASE("Kinds that are off are empty, and do not change the others") {
  Studio studio(scene_with_five_cameras(4));
  const View view = views_of(*studio.scene, studio.poses)[0];
  const Picture all = studio.draw(view);
  const std::size_t pixels = 128 * 128;
  CHECK(all.rgb.size() == 3 * pixels);
  CHECK(all.semantic.size() == pixels);
  for (int bits = 0; bits < 16; ++bits) {
    const PictureKinds kinds{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
    const Picture some = studio.draw(view, {.kinds = kinds});
    CHECK(some.rgb == (kinds.rgb ? all.rgb : decltype(all.rgb){}));
    CHECK(some.depth == (kinds.depth ? all.depth : decltype(all.depth){}));
    CHECK(some.instance == (kinds.instance ? all.instance : decltype(all.instance){}));
    CHECK(some.semantic == (kinds.semantic ? all.semantic : decltype(all.semantic){}));
  }
}

TEST_CASE("Two renderers in one thread do not disturb each other") {
  Studio first(all_shapes()), second(scene_with_five_cameras(3));
  const Picture before = first.draw(view_of_shapes());
  const View other = views_of(*second.scene, second.poses)[0];
  const Picture beside = second.draw(other);
  demand_same(first.draw(view_of_shapes()), before);
  demand_same(second.draw(other), beside);
}
