#include "db/research/check_dataset.h"

#include <algorithm>
#include <map>
#include <set>

#include "db/research/dataset.h"
#include "db/research/problem.h"
#include "engine/base/error.h"

namespace stampede::research {
namespace {

std::string whole(const std::string& column, const std::string& least, const std::string& most) {
  return "(typeof(t." + column + ") = 'integer' AND t." + column + " BETWEEN " + least + " AND " + most + ")";
}

// `(on block1 table)`: words with a space between two.
constexpr const char* kAtom =
    "(typeof(t.fact) = 'text' AND t.fact GLOB '([^ ()]*)' AND instr(substr(t.fact, 2), '(') = 0 AND instr(t.fact, ')') "
    "= length(t.fact) AND instr(t.fact, '  ') = 0 AND instr(t.fact, ' )') = 0)";

std::string list_of_texts(const std::string& column) {
  return "(typeof(t." + column + ") = 'text' AND CASE WHEN json_valid(t." + column + ") THEN json_type(t." + column +
         ") = 'array' AND NOT EXISTS (SELECT 1 FROM json_each(t." + column + ") j WHERE j.type <> 'text') END)";
}

// What a column may hold besides NULL, by its name; `u` is the row of the unit in the list of units.
const std::map<std::string, std::string>& rules() {
  static const std::map<std::string, std::string> all = [] {
    const std::string many = std::to_string(kMostFrames);
    std::map<std::string, std::string> made = {{"frame", whole("frame", "0", "u.frames - 1")},
                                               {"first_frame", whole("first_frame", "0", "u.frames")},
                                               {"end_frame", whole("end_frame", "0", "u.frames")},
                                               {"fact", kAtom},
                                               {"width", whole("width", "1", "65536")},
                                               {"height", whole("height", "1", "65536")}};
    made["arm_joint"] = whole("arm_joint", "1", "16");
    for (const char* count : {"ordinal", "steps", "choice"}) made[count] = whole(count, "0", many);
    for (const char* flag : {"open_end", "driven", "held"}) made[flag] = whole(flag, "0", "1");
    for (const char* list :
         {"arguments", "traits", "before", "after", "added", "removed", "declared", "missing", "undeclared"})
      made[list] = list_of_texts(list);
    return made;
  }();
  return all;
}

class DatasetCheck {
 public:
  explicit DatasetCheck(const PlainFile& file) : file_(file), problem_(find_problem(dataset_problem(file))) {
    unit_ = problem_.unit == Unit::piece ? "piece" : "episode";
  }

  void run() const {
    check_units();
    std::set<std::string> tables;
    for (const auto* uses : {&problem_.given, &problem_.hidden})
      for (const TableUse& use : *uses) tables.insert(use.table());
    for (const std::string& table : tables)  // of ours: what else lies in the file is not read
      if (file_.has(table)) check_table(table);
  }

 private:
  bool any(const std::string& rows) const { return file_.query("SELECT 1" + rows + " LIMIT 1").size() > 0; }

  void check_units() const {
    const std::string table = unit_ + "s";
    if (!file_.has(table)) refuse_unfit(file_, "it lacks the table " + table);
    const std::string number = whole(unit_, "1", "(SELECT count(*) FROM " + table + ")");
    const std::string frames = whole("frames", "0", std::to_string(kMostFrames));
    const std::string rate = "(typeof(t.frame_hz) IN ('integer', 'real') AND t.frame_hz BETWEEN 1 AND 1000000)";
    const std::string split = "t.split IN ('train', 'validation', 'test')";
    for (const std::string& rule : {number, frames, rate, split})
      if (any(" FROM " + table + " t WHERE (" + rule + ") IS NOT TRUE"))
        refuse_unfit(file_, "a row of " + table + " is not as such are: " + rule);
    if (any(" FROM " + table + " GROUP BY " + unit_ + " HAVING count(*) > 1"))
      refuse_unfit(file_, "a number of " + table + " is there twice");
  }

  void check_table(const std::string& table) const {
    const std::vector<std::string> columns = file_.query("SELECT * FROM " + table + " LIMIT 0").columns;
    const auto has = [&](const std::string& name) {
      return std::find(columns.begin(), columns.end(), name) != columns.end();
    };
    if (!has(unit_)) return;  // such as the vocabulary, whose rows are texts
    if (table == "joints" && !has("arm_joint"))
      refuse_unfit(file_, "its table joints does not say which joints are the arm's (column arm_joint)");
    const std::string rows =
        " FROM " + table + " t LEFT JOIN " + unit_ + "s u ON u." + unit_ + " = t." + unit_ + " WHERE ";
    if (any(rows + "typeof(t." + unit_ + ") <> 'integer' OR u." + unit_ + " IS NULL"))
      refuse_unfit(file_, "a row of " + table + " is of an " + unit_ + " that is not there");
    std::string all;
    std::vector<std::pair<std::string, std::string>> held;  // column, rule
    for (const auto& [column, rule] : rules()) {
      const bool counts = table == "vocabulary" && column == "arguments";  // it says how many a predicate takes
      if (!has(column) || counts) continue;
      held.emplace_back(column, "(t." + column + " IS NULL OR " + rule + ") IS NOT TRUE");
      all += (all.empty() ? "" : " OR ") + held.back().second;
    }
    if (has("first_frame") && has("end_frame")) {
      held.emplace_back("end_frame", "t.end_frame < t.first_frame");
      all += " OR " + held.back().second;
    }
    if (held.empty() || !any(rows + all)) return;
    for (const auto& [column, broken] : held)
      if (any(rows + broken)) refuse_unfit(file_, "a value of " + table + "." + column + " can be none");
  }

  const PlainFile& file_;
  const ResearchProblem& problem_;
  std::string unit_;
};

}  // namespace

PlainFile open_dataset(const std::filesystem::path& file) {
  PlainFile opened = PlainFile::open(file);
  DatasetCheck(opened).run();
  return opened;
}

void refuse_unfit(const PlainFile& file, const std::string& what) {
  throw CatalogueError(file.path().string(), what,
                       "the data set was damaged or changed by hand: make it again with `stampede dataset`");
}

}  // namespace stampede::research
