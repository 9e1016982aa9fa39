// The world in symbols beside its pictures: what was hidden in a closed drawer is known once the drawer has been
// opened.
#include <stampede/session.h>

#include <cstdio>

int main() {
  stampede::Session session({.catalogue = "states.db"});
  const stampede::Episode e = session.run("find_item_in_drawer", {.seed = 7});
  const auto hidden = [&](std::int64_t frame) {
    int count = 0;
    for (const stampede::StateFact& fact : session.state(e.id, frame).facts) count += fact.holds && !fact.known;
    return count;
  };
  const int at_first = hidden(0), at_last = hidden(e.frames - 1);
  const stampede::WorldState last = session.state(e.id, e.frames - 1);
  double widest = 0;
  for (const stampede::StateJoint& joint : last.joints)
    if (joint.name.find("drawer") != std::string::npos && joint.fraction > widest) widest = joint.fraction;
  std::printf("%d facts hidden at first, %d at last; a drawer is %.0f %% open, %zu poses, %.2f s\n", at_first, at_last,
              100 * widest, last.objects.size(), last.time_s);
  return e.outcome == stampede::Outcome::success && at_first > 0 && at_last < at_first && widest > 0.5 ? 0 : 1;
}
