#include "db/research/dataset.h"

#include <algorithm>
#include <map>
#include <optional>

#include "db/research/answers.h"
#include "db/research/arm_joints.h"
#include "db/research/computed_tables.h"
#include "db/research/datasheet.h"
#include "db/research/leaks.h"
#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/scratch_folder.h"
#include "engine/base/text_file.h"

namespace stampede::research {
namespace {

namespace fs = std::filesystem;

// An episode, or a piece of one, and its number in the data set.
struct Member {
  std::int64_t episode = 0, segment = -1, number = 0;
  std::string key, split;
};

// By a hash of problem and key: the order says nothing of how episodes were made, nor two data sets of each other.
void number_anew(std::vector<Member>& members, const std::string& problem) {
  const auto lot = [&](const Member& one) {
    return content_hash(problem + "|" + one.key + "|" + std::to_string(one.segment));
  };
  std::sort(members.begin(), members.end(), [&](const Member& a, const Member& b) { return lot(a) < lot(b); });
  std::int64_t number = 0;
  for (Member& one : members) one.number = ++number;
}

std::vector<Member> members_of(const Catalogue& catalogue, const ResearchProblem& problem,
                               const std::vector<SplitEpisode>& episodes, const Split& split) {
  std::vector<Member> members;
  for (const SplitEpisode& episode : episodes) {
    const Member whole{.episode = episode.id, .key = episode.key, .split = split.of.at(episode.id)};
    if (problem.unit == Unit::episode) {
      members.push_back(whole);
      continue;
    }
    const Rows rows = catalogue.query(
        "SELECT segment FROM segments WHERE episode = ?1 AND kind = 'skill' AND end_frame > first_frame ORDER BY "
        "segment",
        {.parameters = {episode.id}});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      members.push_back(whole);
      members.back().segment = rows.integer(i, "segment");
    }
  }
  number_anew(members, problem.name);
  return members;
}

const char* unit_column(const ResearchProblem& problem) { return problem.unit == Unit::piece ? "piece" : "episode"; }

bool takes(Part part, const std::string& split) {
  return part == Part::all || (part == Part::test) == (split == "test");
}

ArmJoints arm_joints_in(const Catalogue& catalogue, const std::vector<Member>& members) {
  std::map<std::int64_t, int> of_episode;
  ArmJoints arm;
  int fewest = 0;  // of a test episode; 0: none has one
  for (const Member& one : members) {
    const auto [counted, is_new] = of_episode.try_emplace(one.episode, 0);
    if (is_new)
      counted->second =
          static_cast<int>(catalogue
                               .query("SELECT count(arm_joint) AS joints FROM joints WHERE episode = ?1 AND frame = 0",
                                      {.parameters = {one.episode}})
                               .integer(0, "joints"));
    const int joints = counted->second;
    arm.most = std::max(arm.most, joints);
    if (one.split == "test" && joints > 0) fewest = fewest == 0 ? joints : std::min(fewest, joints);
  }
  arm.fewest = fewest == 0 ? arm.most : fewest;
  return arm;
}

// Rows of a SELECT into a table, with the unit's number before each; what is written is hashed.
class TableFiller : public RowReceiver {
 public:
  // `unit`: the number's column. `file`: null where it is only hashed.
  TableFiller(const char* unit, PlainFileWriter* file, Hasher& hasher) : unit_(unit), file_(file), hasher_(hasher) {}
  void begin(const std::string& table) { table_ = table, names_.clear(); }
  void of_unit(std::int64_t number) { number_ = number; }
  void columns(const std::vector<std::string>& names) override {
    if (names == names_) return;
    if (!names_.empty()) throw Error("db/datasets", "the SELECTs of table " + table_ + " have different columns");
    names_ = names;
    std::vector<std::string> all = {unit_};
    all.insert(all.end(), names.begin(), names.end());
    hasher_.text(table_);
    for (const std::string& name : all) hasher_.text(name);
    if (file_) file_->table(table_, all);
  }
  bool row(const std::vector<SqlValue>& values) override {
    row_.assign(1, number_);
    row_.insert(row_.end(), values.begin(), values.end());
    for (const SqlValue& value : row_) hash(value);
    if (file_) file_->row(row_);
    ++rows_;
    return true;
  }
  std::int64_t rows() const { return rows_; }

 private:
  void hash(const SqlValue& value) {
    hasher_.number(static_cast<std::int64_t>(value.index()));
    if (const auto* integer = std::get_if<std::int64_t>(&value)) hasher_.number(*integer);
    if (const auto* real = std::get_if<double>(&value)) hasher_.number(*real);
    if (const auto* text = std::get_if<std::string>(&value)) hasher_.text(*text);
    if (const auto* blob = std::get_if<SqlBlob>(&value)) hasher_.text(blob->bytes);
  }

  const char* unit_;
  PlainFileWriter* file_;
  Hasher& hasher_;
  std::string table_;
  std::vector<std::string> names_;
  std::vector<SqlValue> row_;
  std::int64_t number_ = 0, rows_ = 0;
};

// How many of ?1 ?2 ?3 a SELECT takes.
std::size_t parameters_of(const std::string& select) {
  for (const std::size_t n : {3, 2, 1})
    if (select.find("?" + std::to_string(n)) != std::string::npos) return n;
  return 0;
}

// Episodes are asked for tables one by one, and the tables have columns for all joints of the longest arm.
struct Source {
  const Catalogue& catalogue;
  ArmJoints arm;
};

void ask(const Source& source, const std::string& table, const Member& one, RowReceiver& receiver) {
  if (const ComputedTable* computed = find_computed_table(table)) {
    const Rows rows = computed->rows(source.catalogue, one.episode);
    receiver.columns(rows.columns);
    for (const auto& row : rows.rows) receiver.row(row);
    return;
  }
  const DatasetTable* file = find_dataset_table(table);
  if (!file) throw Error("db/datasets", "there is no file " + table + ".sql");
  std::vector<SqlValue> parameters = {one.episode, one.segment, one.split};
  parameters.resize(parameters_of(file->select));
  source.catalogue.query(with_arm_joints(file->select, source.arm.most), receiver, {.parameters = parameters});
}

// Whether a table has a row, or one with a value in a column; asks for no more than that.
class ValueFinder : public RowReceiver {
 public:
  explicit ValueFinder(const std::string& column) : column_(column) {}
  bool found() const { return found_; }
  void columns(const std::vector<std::string>& names) override {
    place_ = static_cast<std::size_t>(std::find(names.begin(), names.end(), column_) - names.begin());
  }
  bool row(const std::vector<SqlValue>& values) override {
    found_ = found_ || column_.empty() || !std::holds_alternative<std::monostate>(values.at(place_));
    return !found_;
  }

 private:
  const std::string& column_;
  std::size_t place_ = 0;
  bool found_ = false;
};

// A data set that nobody could learn from, or that nothing could be scored against, is none.
void check_needs(const Source& source, const ResearchProblem& problem, const std::vector<Member>& members,
                 const std::string& where) {
  const auto has = [&](const Need& need, const std::vector<TableUse>& uses, bool test) {
    ValueFinder finder(need.column);
    for (const TableUse& use : uses)
      for (const Member& one : members)
        if (use.table() == need.table && takes(use.part, one.split) && (one.split == "test") == test && !finder.found())
          ask(source, use.select, one, finder);
    return finder.found();
  };
  for (const Need& need : problem.needs)
    for (const auto& [uses, test] : {std::pair{&problem.given, false}, {&problem.hidden, true}}) {
      const auto use =
          std::find_if(uses->begin(), uses->end(), [&](const auto& it) { return it.table() == need.table; });
      if (use == uses->end() || has(need, *uses, test)) continue;
      throw Error(where,
                  std::string("there is nothing to ") + (test ? "score against" : "learn from") + ": no " +
                      (test ? "test" : "training") + " episode has anything for table " + need.table +
                      (need.column.empty() ? "" : ", column " + need.column) + ", which " + problem.name + " needs",
                  "it is: " + describe_table(use->select) +
                      " Simulated episodes have it (`stampede run`); recordings have neither goals and plans nor kinds "
                      "of facts, and skills where they are labelled (`stampede import labels`)");
    }
}

std::int64_t fill(const Source& source, const std::vector<TableUse>& uses, const std::vector<Member>& members,
                  TableFiller filler) {
  std::string table;
  for (const TableUse& use : uses) {
    if (use.table() != table) filler.begin(table = use.table());
    for (const Member& one : members) {
      if (!takes(use.part, one.split)) continue;
      filler.of_unit(one.number);
      ask(source, use.select, one, filler);
    }
  }
  return filler.rows();
}

void write_index(const Catalogue& catalogue, const ResearchProblem& problem, const std::vector<Member>& members,
                 PlainFileWriter& file) {
  file.table(unit_column(problem) + std::string("s"), {unit_column(problem), "split", "frames", "frame_hz"});
  for (const Member& one : members) {
    const Rows rows =
        problem.unit == Unit::episode
            ? catalogue.query("SELECT frames, frame_hz FROM episodes WHERE episode = ?1", {.parameters = {one.episode}})
            : catalogue.query(
                  "SELECT s.end_frame - s.first_frame AS frames, e.frame_hz FROM segments s JOIN "
                  "episodes e USING (episode) WHERE s.episode = ?1 AND s.segment = ?2",
                  {.parameters = {one.episode, one.segment}});
    file.row({one.number, one.split, rows.integer(0, "frames"), rows.integer(0, "frame_hz")});
  }
}

void write_identity(PlainFileWriter& file, const ResearchProblem& problem, const std::string& id,
                    const std::string& split) {
  file.table("dataset", {"id", "problem", "split"});
  file.row({id, problem.name, split});
}

// A folder may be new, empty, or hold a data set of this problem, which is made anew; anything else is left alone.
void check_folder(const fs::path& folder, const char* file, const ResearchProblem& problem) {
  std::error_code error;
  const auto empty = [&] {
    for (const fs::directory_entry& one : fs::directory_iterator(folder, error))
      if (!ScratchFolder::is_one(one.path(), folder / file)) return false;  // of a program that was killed
    return true;
  };
  if (!fs::is_directory(folder, error) || empty()) return;
  const std::string cure = "name a folder that is new or empty, or remove what is in this one";
  if (!fs::exists(folder / file, error))
    throw Error(folder.string(),
                "this folder is not empty, and holds no such part of a data set (" + std::string(file) +
                    "): nothing was written",
                cure);
  const std::string found = dataset_problem(PlainFile::open(folder / file));
  if (found != problem.name)
    throw Error(folder.string(), "in this folder lies a data set of " + found + ": nothing was written", cure);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw CatalogueError(folder.string(), "this folder cannot be made" + (error ? ": " + error.message() : ""),
                         "name another, or one that you may write in");
}

std::string text_of(const PlainFile& file, const char* column) {
  if (!file.has("dataset"))
    throw CatalogueError(file.path().string(), "this database is no data set of ours",
                         "name a folder that `stampede dataset` has made");
  return file.query("SELECT * FROM dataset").text(0, column);
}

}  // namespace

std::string dataset_id(const PlainFile& file) { return text_of(file, "id"); }
std::string dataset_problem(const PlainFile& file) { return text_of(file, "problem"); }

DatasetReport make_dataset(const ResearchProblem& asked, const DatasetRequest& request) {
  const SplitRule rule = split_rule(request.split);
  check_folder(request.given, kGivenFile, asked);
  if (!request.hidden.empty()) check_folder(request.hidden, kHiddenFile, asked);
  const Catalogue catalogue = Catalogue::open(request.catalogue);
  const std::vector<SplitEpisode> episodes = episodes_to_split(catalogue, asked.demos_only, request.where);
  if (episodes.empty())
    throw Error(request.catalogue.string(),
                std::string(asked.demos_only ? "no episode of this catalogue succeeded"
                                             : "no episode of this catalogue has frames") +
                    (request.where.empty() ? "" : ", of those where " + request.where),
                asked.name + " is made of " + (asked.demos_only ? "successes" : "episodes with frames") +
                    ": `stampede query FILE failures_by_reason` says why there are none");
  const Split split = split_episodes(episodes, rule);
  const std::vector<Member> members = members_of(catalogue, asked, episodes, split);
  const Source source{catalogue, arm_joints_in(catalogue, members)};
  const ResearchProblem problem = with_arm_joints(asked, source.arm);
  check_needs(source, problem, members, request.catalogue.string());
  make_folder(request.given);
  if (!request.hidden.empty()) make_folder(request.hidden);

  Hasher hasher;
  hasher.text(problem.name).text(rule.text());
  for (const Member& one : members) hasher.number(one.number).text(one.split);
  PlainFileWriter given(request.given / kGivenFile);
  std::optional<PlainFileWriter> hidden;
  if (!request.hidden.empty()) hidden.emplace(request.hidden / kHiddenFile);
  DatasetReport report;
  const char* unit = unit_column(problem);
  report.given_rows = fill(source, problem.given, members, TableFiller(unit, &given, hasher));
  report.hidden_rows = fill(source, problem.hidden, members, TableFiller(unit, hidden ? &*hidden : nullptr, hasher));
  report.id = hasher.digest();
  std::vector<std::int64_t> tests;
  for (const Member& one : members) {
    ++(one.split == "train" ? report.train : one.split == "test" ? report.test : report.validation);
    if (one.split == "test") tests.push_back(one.number);
  }
  write_index(catalogue, problem, members, given);
  write_identity(given, problem, report.id, rule.text());
  if (hidden) {
    write_index(catalogue, problem, members, *hidden);
    write_identity(*hidden, problem, report.id, rule.text());
    hidden->table("held_out", {"kind", "first", "second"});
    for (const HeldOut& one : split.held_out) hidden->row({one.kind, one.first, one.second});
    hidden->finish();
  }
  given.finish();
  // After the files, by which a folder is known to be ours.
  DatasheetFacts facts = datasheet_facts(catalogue, episodes, split, rule);
  const Leaks leaks = leaks_of(catalogue, episodes, split, rule);
  facts.where = request.where;
  facts.leaks = leaks_text(leaks, rule);
  report.leaks = leaks_line(leaks);
  write_text_file(request.given / "answers.example.json", example_answers(problem, report.id, tests));
  write_text_file(request.given / "README.md", given_sheet(problem, facts, report));
  if (hidden) write_text_file(request.hidden / "README.md", hidden_sheet(problem, facts, report));
  return report;
}

}  // namespace stampede::research
