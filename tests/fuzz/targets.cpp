#include "tests/fuzz/targets.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <lua.hpp>

#include "db/catalogue.h"
#include "engine/base/error.h"
#include "engine/bddl/bddl.h"
#include "engine/geometry/drawn_mesh.h"
#include "engine/geometry/mesh.h"
#include "engine/model/camera.h"
#include "engine/model/urdf.h"
#include "engine/symbolic/pddl.h"
#include "scripting/library/library.h"
#include "scripting/lua/sandbox.h"

namespace stampede::fuzz {
namespace fs = std::filesystem;
namespace {

const fs::path kSource = STAMPEDE_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> texts_in(const fs::path& folder, const std::string& ending, std::size_t most = 20) {
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::recursive_directory_iterator at(folder, code), end; !code && at != end; at.increment(code))
    if (at->path().extension() == ending) files.push_back(at->path());
  std::sort(files.begin(), files.end());
  if (files.size() > most) files.resize(most);
  std::vector<std::string> texts;
  for (const fs::path& file : files) texts.push_back(text_of(file));
  return texts;
}

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
    std::ofstream(path_ / name, std::ios::binary) << bytes;
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

const char* const kDomain =
    "(define (domain d) (:requirements :adl :derived-predicates) (:types a b - object) (:constants k - a)\n"
    " (:predicates (p ?x - a) (q ?x - a ?y - b) (r ?y - b)) (:derived (r ?y - b) (exists (?x - a) (q ?x ?y)))\n"
    " (:action go :parameters (?x - a ?y - b) :precondition (and (p ?x) (not (r ?y)) (or (p k) (= ?x k)))\n"
    "  :effect (and (q ?x ?y) (when (p ?x) (not (p ?x))) (forall (?z - a) (p ?z)))))";
const char* const kProblem =
    "(define (problem e) (:domain d) (:objects o - a u - b) (:init (p o)) (:goal (and (r u) (not (p k)))))";

const char* const kLibero =
    "(define (problem LIBERO_T)\n (:domain robosuite)\n (:language put the cup on the plate)\n (:regions\n"
    "  (cup_region (:target table) (:ranges ((-0.1 -0.2 0.1 0.2))) (:yaw_rotation ((0.0 0.1)))))\n"
    " (:fixtures table - table)\n (:objects cup_1 - cup plate_1 - plate)\n (:obj_of_interest cup_1)\n"
    " (:init (On cup_1 table_cup_region) (On plate_1 table_cup_region))\n (:goal (And (On cup_1 plate_1))))\n";
const char* const kBehaviour =
    "(define (problem t)\n (:domain omnigibson)\n (:objects bowl.n.01_1 bowl.n.01_2 - bowl.n.01 table.n.02_1 - "
    "table.n.02)\n (:init (ontop bowl.n.01_1 table.n.02_1) (inroom table.n.02_1 kitchen))\n"
    " (:goal (and (forall (?b - bowl.n.01) (not (ontop ?b ?table.n.02_1)))\n"
    "  (forpairs (?a - bowl.n.01) (?t - table.n.02) (nextto ?a ?t))\n"
    "  (forn (1) (?a - bowl.n.01) (exists (?t - table.n.02) (ontop ?a ?t))))))\n";

// Domain and problem in one file, one after the other, as neither alone says much.
void read_pddl(std::string_view bytes) {
  const std::size_t cut = bytes.find('\n' + std::string("(define (problem"));
  answered([&] {
    const Domain domain = domain_from_pddl(bytes.substr(0, cut), "domain.pddl");
    if (cut == std::string_view::npos) return;
    const Problem problem = problem_from_pddl(bytes.substr(cut + 1), "problem.pddl", domain);
    (void)validate(domain, problem, plan_from_text("(go o u)\n", "plan"));
  });
  answered([&] { (void)formula_from_pddl(bytes, "formula"); });
  answered([&] { (void)plan_from_text(bytes, "plan"); });
}

void read_lua(std::string_view bytes) {
  answered([&] {  // as a chunk, with little of everything
    Sandbox sandbox({200'000, 8u << 20, 1.0}, {});
    sandbox.run(Sandbox::compile(bytes, "tasks/fuzzed.lua"), "tasks/fuzzed.lua", 1);
  });
  answered([&] {  // as a task among the small root's files
    scratch().put("root/tasks/fuzzed.lua", bytes);
    std::vector<Error> complaints;
    (void)Library::load({{kSource / "tests/scripting/data/runtime", scratch().path() / "root"}}, complaints);
  });
}

Catalogue seed_catalogue(const fs::path& file) {
  fs::remove(file);
  return Catalogue::write(file);
}

std::string catalogue_bytes() {
  const fs::path file = scratch().path() / "seed.db";
  seed_catalogue(file).close();
  return text_of(file);
}

void read_catalogue(std::string_view bytes) {
  const fs::path file = scratch().put("fuzzed.db", bytes);
  for (const char* rest : {"fuzzed.db-wal", "fuzzed.db-shm", "fuzzed.db-journal"}) fs::remove(scratch().path() / rest);
  answered([&] {
    const Catalogue catalogue = Catalogue::open(file);
    for (const EpisodeSummary& episode : catalogue.episodes()) (void)catalogue.read_episode(episode.id);
    (void)catalogue.content_hash();
  });
}

void ask(std::string_view question) {
  static const Catalogue catalogue = seed_catalogue(scratch().path() / "asked.db");
  answered([&] { (void)catalogue.query(std::string(question)); });
}

std::vector<Target> all_targets() {
  const std::string pair = std::string(kDomain) + "\n" + kProblem;
  const auto urdf = [](std::string_view bytes) {
    answered([&] { (void)read_urdf(scratch().put("fuzzed.urdf", bytes)); });
  };
  const auto calibration = [](std::string_view bytes) {
    answered([&] { (void)load_calibration(scratch().put("fuzzed.json", bytes), Scene{}); });
  };
  const auto picture = [](std::string_view bytes) {
    answered([&] { (void)load_image(scratch().put("fuzzed.png", bytes)); });
  };
  const auto mesh = [](const std::string& ending) {
    return [ending](std::string_view bytes) {
      answered([&] { (void)load_hulls(scratch().put("fuzzed" + ending, bytes)); });
    };
  };
  Scene scene;
  scene.bodies.emplace_back();
  scene.bodies.back().name = "cube";
  scene.bodies.back().parts.emplace_back();
  scene.bodies.back().parts.back().shapes.emplace_back();
  const std::string png = "\x89PNG\r\n\x1a\n" +
                          std::string("\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\6\0\0\0\x1f\x15\xc4\x89", 25) +
                          std::string(
                              "\0\0\0\rIDATx\x9c"
                              "c\xf8\xcf\xc0\xf0\x1f\0\5\0\1\xff\x89\x99=\x1d\0\0\0\0IEND\xae"
                              "B`\x82",
                              37);
  return {
      {"pddl",
       read_pddl,
       {pair},
       {"(and ", "(forall (?x - a) ", "(not ", ":derived", "- -", "?x", "(either a b)", ")"}},
      {"bddl",
       [](std::string_view bytes) { answered([&] { check_bddl(read_bddl(bytes, "fuzzed.bddl").problem); }); },
       {kLibero, kBehaviour},
       {"(:regions ", "(:goal ", "(forpairs ", "(:ranges ", "(0 0 1 1)", "- floor", "?x", ")"}},
      {"lua",
       read_lua,
       texts_in(kSource / "tests/scripting/data/runtime", ".lua"),
       {"return task {", "is.on(", "one_of(", "function(v) ", " end", "{}", "0/0", "math.huge", "..", "goto x"}},
      {"urdf",
       urdf,
       {text_of(kSource / "worlds/robots/panda.urdf").substr(0, 6000) + "</robot>",
        "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/>"
        "<child link='b'/></joint></robot>"},
       {"<link name='a'>", "<joint type='prismatic'>", "%s", "&#37;", "<mesh filename='a.obj'/>", "nan", "1e999",
        "/>"}},
      {"scene",
       [](std::string_view bytes) { answered([&] { (void)scene_from_document(bytes); }); },
       {scene_to_document(scene)},
       {"null", "1e999", "-1", "[]", "{}", "\"shapes\":", "9999999999"}},
      {"calibration",
       calibration,
       {R"({"cameras":[{"name":"a","width":64,"height":48,"camera_matrix":[[60,0,32],[0,60,24],[0,0,1]]}]})"},
       {"null", "1e999", "-1", "[]", "{}", "\"distortion\":[0,0,0,0,0],", "\"mount\":"}},
      {"png", picture, {png}, {"IHDR", "IDAT", "PLTE", "tRNS", "IEND", std::string(4, '\xff'), std::string(4, '\0')}},
      {"sql",
       ask,
       {"SELECT task, count(*) FROM episodes GROUP BY task", "WITH a AS (SELECT 1) SELECT * FROM a, segments"},
       {"SELECT ", " FROM ", " WHERE ", "episodes", "json_each(", "RECURSIVE", "PRAGMA ", "ATTACH ", "printf('%n')",
        ";"}},
      {"catalogue", read_catalogue, {catalogue_bytes()}, {std::string(8, '\xff'), std::string(8, '\0'), "episode"}},
      {"ply",
       mesh(".ply"),
       {"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "4\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n"
        "3 2 0 3\n"},
       {"element ", "property ", "list ", "999999999", "-1", "binary_little_endian", "nan"}},
      {"obj",
       mesh(".obj"),
       {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"},
       {"vt 0 0\n", "f 1/1/1", "mtllib a.mtl\n", "-1", "999999999", "usemtl ", "nan"}},
  };
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = all_targets();
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
