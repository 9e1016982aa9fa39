#include <cstdio>
#include <stampede/session.h>

int main() {
  stampede::Session session({.catalogue = "demos.db"});
  for (const std::string& variation : session.variations("stack_blocks")) {
    const stampede::Episode e = session.run("stack_blocks", {.variation = variation, .seed = 7});
    std::printf("%s %.1f s\n", e.outcome == stampede::Outcome::success ? "success" : e.reason.c_str(), e.duration_s);
  }
}
