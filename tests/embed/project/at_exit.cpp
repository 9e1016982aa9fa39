// Objects that go when the process ends: a session that has drawn, and an environment that has.
#include <cstdio>
#include <optional>
#include <stampede/session.h>

namespace {

stampede::Session session({});
std::optional<stampede::Environment> world;

}  // namespace

int main() {
  const stampede::Episode e = session.run("reach_target", {.seed = 7});
  const stampede::CameraPicture picture = session.picture(e, 0, {.width = 64, .height = 48});
  world.emplace(session.environment("reach_target", {.channels = {"front_rgb"}, .width = 64, .height = 48}));
  const std::size_t seen = world->reset({.seed = 7})["front_rgb"].bytes().size();
  std::printf("%zu and %zu bytes\n", picture.rgb.size(), seen);
  return picture.rgb.size() == seen && seen > 0 ? 0 : 1;
}
