#include "tests/fuzz/targets.h"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <lua.hpp>
#include <stdexcept>

#include "db/catalogue.h"
#include "db/research/answers.h"
#include "engine/base/error.h"
#include "engine/bddl/bddl.h"
#include "engine/geometry/drawn_mesh.h"
#include "engine/geometry/mesh.h"
#include "engine/model/camera.h"
#include "engine/model/urdf.h"
#include "engine/symbolic/pddl.h"
#include "fuzz_pddl.h"
#include "scripting/library/library.h"
#include "scripting/lua/sandbox.h"
#include "tests/fuzz/catalogue.h"
#include "tests/fuzz/schema.h"

namespace stampede::fuzz {
namespace fs = std::filesystem;
namespace {

const fs::path kSource = STAMPEDE_SOURCE_DIR;

class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / ("stampede_fuzz_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path put(const std::string& name, std::string_view bytes) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary | std::ios::trunc) << bytes;
    return path_ / name;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

const Scratch& scratch() {
  static const Scratch folder;
  return folder;
}

// What `read` throws of our own is an answer.
template <typename Read>
void answered(const Read& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

// Domain and problem in one file, one after the other, as neither alone says much.
void read_pddl(std::string_view bytes) {
  test::read_as_pddl(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const std::size_t cut = bytes.find("\n(define (problem");
  if (cut == std::string_view::npos) return;
  answered([&] {
    const Domain domain = domain_from_pddl(bytes.substr(0, cut), "domain.pddl");
    const Problem problem = problem_from_pddl(bytes.substr(cut + 1), "problem.pddl", domain);
    (void)validate(domain, problem, plan_from_text("(go o u)\n", "plan"));
  });
}

void read_lua(std::string_view bytes) {
  answered([&] {  // as a chunk, with little of everything
    Sandbox sandbox({200'000, 8u << 20, 1.0}, {});
    sandbox.run(Sandbox::compile(bytes, "tasks/fuzzed.lua"), "tasks/fuzzed.lua", 1);
  });
  answered([&] {  // as a task among the small root's files
    scratch().put("root/tasks/fuzzed.lua", bytes);
    std::vector<Error> complaints;
    (void)Library::check({{kSource / "tests/scripting/data/runtime", scratch().path() / "root"}}, complaints);
  });
}

void read_catalogue(std::string_view bytes) {
  const fs::path file = scratch().path() / "fuzzed.db";
  for (const char* rest : {"fuzzed.db-wal", "fuzzed.db-shm", "fuzzed.db-journal"}) fs::remove(scratch().path() / rest);
  write_altered_catalogue(file, bytes);
  answered([&] {
    const Catalogue catalogue = Catalogue::open(file);
    for (const EpisodeSummary& episode : catalogue.episodes()) {
      answered([&] { (void)catalogue.read_episode(episode.id); });
      answered([&] { (void)catalogue.read_arrays(episode.id); });
      answered([&] {
        for (const ImageEntry& image : catalogue.images(episode.id))
          (void)catalogue.read_image(episode.id, image.frame, image.camera, image.kind);
      });
    }
    (void)catalogue.content_hash();
  });
}

// Some rows of an answer; a question may well take for ever, and is interrupted.
void ask(std::string_view question) {
  static const Catalogue catalogue = [] {
    write_altered_catalogue(scratch().path() / "asked.db", {});
    return Catalogue::open(scratch().path() / "asked.db");
  }();
  std::signal(SIGVTALRM, [](int) { catalogue.interrupt(); });
  constexpr itimerval kLongest{{}, {0, 300'000}}, kNever{};  // of CPU
  setitimer(ITIMER_VIRTUAL, &kLongest, nullptr);
  answered([&] {
    QueryOptions some;
    some.most_rows = 100;
    (void)catalogue.query(std::string(question), some);
  });
  setitimer(ITIMER_VIRTUAL, &kNever, nullptr);
}

// As answers to each research problem; what is read is what is written.
void read_as_answers(std::string_view bytes) {
  const fs::path file = scratch().put("answers", bytes);
  for (const research::ResearchProblem& problem : research::all_problems())
    answered([&] {
      const research::Answers answers = research::read_answers(file, problem);
      scratch().put("again", research::answers_text(answers));
      const research::Answers again = research::read_answers(scratch().path() / "again", problem);
      if (again.rows.rows != answers.rows.rows || again.texts != answers.texts)
        throw std::logic_error("answers to " + problem.name + " change when they are written");
    });
}

// What reads a file of that name, as a reader of bytes.
template <typename Read>
Target of_file(const std::string& name, const std::string& file, const Read& read) {
  return {name, [file, read](std::string_view bytes) { answered([&] { (void)read(scratch().put(file, bytes)); }); }};
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"pddl", read_pddl},
      {"answers", read_as_answers},
      {"bddl", [](std::string_view bytes) { answered([&] { check_bddl(read_bddl(bytes, "fuzzed.bddl").problem); }); }},
      {"lua", read_lua},
      of_file("urdf", "fuzzed.urdf", [](const fs::path& file) { return read_urdf(file); }),
      {"scene", [](std::string_view bytes) { answered([&] { (void)scene_from_document(bytes); }); }},
      of_file("calibration", "fuzzed.json", [](const fs::path& file) { return load_calibration(file, Scene{}); }),
      of_file("png", "fuzzed.png", [](const fs::path& file) { return load_image(file); }),
      {"sql", ask},
      {"catalogue", read_catalogue},
      {"schema",
       [](std::string_view bytes) {
         fs::create_directories(scratch().path() / "schema");
         use_altered_schema(scratch().path() / "schema", bytes);
       }},
      of_file("ply", "fuzzed.ply", [](const fs::path& file) { return load_hulls(file); }),
      of_file("stl", "fuzzed.stl", [](const fs::path& file) { return load_hulls(file); }),
      of_file("dae", "fuzzed.dae", [](const fs::path& file) { return load_hulls(file); }),
      of_file("gltf", "fuzzed.gltf", [](const fs::path& file) { return load_hulls(file); }),
      of_file("glb", "fuzzed.glb", [](const fs::path& file) { return load_hulls(file); }),
      of_file("obj", "fuzzed.obj", [](const fs::path& file) { return load_hulls(file); })};
  return all;
}

const Target& target(std::string_view name) {
  std::string known;
  for (const Target& one : targets()) {
    if (one.name == name) return one;
    known += " " + one.name;
  }
  throw Error(std::string(name), "there is no such target", "one of" + known);
}

}  // namespace stampede::fuzz
