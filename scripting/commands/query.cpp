#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <ostream>
#include <thread>

#include "db/catalogue_set.h"
#include "db/reference.h"
#include "db/table_text.h"
#include "scripting/commands/commands.h"

namespace stampede::program {
namespace {

// While it lives, Ctrl-C ends the running question.
class StopsQuestion {
 public:
  StopsQuestion(const CatalogueSet& catalogue, const Console& console)
      : watcher_([this, &catalogue, &console] {
          while (!done_) {
            if (console.stopped()) catalogue.interrupt();
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        }) {}
  ~StopsQuestion() {
    done_ = true;
    watcher_.join();
  }
  StopsQuestion(const StopsQuestion&) = delete;
  StopsQuestion& operator=(const StopsQuestion&) = delete;

 private:
  std::atomic<bool> done_ = false;
  std::thread watcher_;  // last: it reads done_
};

QueryResult names() {
  QueryResult table;
  table.columns = {"query", "description"};
  for (const NamedQuery& query : named_queries()) table.rows.push_back({query.name, query.description});
  return table;
}

QueryResult views() {
  QueryResult table;
  table.columns = {"view", "column", "meaning", "unit", "frame", "null"};
  for (const ViewReference& view : view_reference()) {
    table.rows.push_back(
        {view.name, std::monostate{}, view.description, std::monostate{}, std::monostate{}, std::monostate{}});
    const auto known = [](const std::string& cell) { return cell.empty() ? SqlValue{} : SqlValue{cell}; };
    for (const ViewColumn& column : view.columns)
      table.rows.push_back(
          {view.name, column.name, column.meaning, known(column.unit), known(column.frame), column.null});
  }
  return table;
}

TextFormat format_of(const Arguments& arguments) {
  const std::string name = arguments.flag("--json") ? "json" : arguments.text("--format");
  return name == "json" ? TextFormat::json : name == "csv" ? TextFormat::csv : TextFormat::table;
}

ExitCode answer(const Arguments& arguments, RowWriter& writer, Console& console) {
  const std::vector<std::string>& files = arguments.list("FILE");
  const CatalogueSet catalogue({files.begin(), files.end()});
  if (const std::int64_t unknown = catalogue.not_indexed(); unknown > 0)
    console.err << fmt::format("{} catalogues below {} are not in its index: `stampede index {}`\n", unknown,
                               files.front(), files.front());
  try {
    const StopsQuestion stops(catalogue, console);
    catalogue.query(arguments.text("QUESTION"), writer);
  } catch (const std::exception&) {
    if (!console.stopped()) throw;
    console.err << "interrupted: the question was not answered to its end\n";
    return kInterrupted;
  }
  writer.finish();
  return kDone;
}

// The catalogue of an option that is about one.
std::string only_file(const Arguments& arguments, const std::string& option) {
  if (!arguments.has("FILE")) throw UsageError("stampede query " + option + " needs FILE", "name a catalogue");
  if (arguments.has("QUESTION"))
    throw UsageError("stampede query " + option + " takes one FILE and nothing else", "name one catalogue at a time");
  return arguments.text("FILE");
}

// Of a question that is not the last word, the last word is a file.
void check_question(const std::string& question) {
  std::error_code ignored;
  if (find_named_query(question) || !std::filesystem::is_regular_file(question, ignored)) return;
  throw UsageError("the last argument is the question, and '" + question + "' is a file",
                   "stampede query FILE... QUESTION: SQL in quotes, or a name of stampede query --list");
}

ExitCode do_query(const Arguments& arguments, Console& console) {
  const std::unique_ptr<RowWriter> writer = row_writer(format_of(arguments), console.out);
  const auto write = [&](const QueryResult& result) {
    writer->columns(result.columns);
    for (const auto& row : result.rows) writer->row(row);
    writer->finish();
    return kDone;
  };
  if (arguments.flag("--list")) return write(names());
  if (arguments.flag("--views")) return write(views());
  if (arguments.flag("--datasette")) {
    console.out << datasette_metadata(std::filesystem::path(only_file(arguments, "--datasette")).stem().string());
    return kDone;
  }
  if (arguments.flag("--hash")) {
    QueryResult hash;
    hash.columns = {"content_hash"};
    hash.rows = {{Catalogue::open(only_file(arguments, "--hash")).content_hash()}};
    return write(hash);
  }
  if (!arguments.has("FILE") || !arguments.has("QUESTION"))
    throw UsageError("stampede query needs FILE and QUESTION", "stampede query --list names the ready questions");
  check_question(arguments.text("QUESTION"));
  return answer(arguments, *writer, console);
}

}  // namespace

CommandRow query_command() {
  return {
      "query",
      "Ask catalogues in SQL, or by the name of a ready question",
      "Catalogues are opened read-only: a question that would write is refused. The views that SQL may use are "
      "described in db/README.md, and by --views; --list names the ready questions. Several files are asked as one: "
      "episodes are numbered anew, file by file, one that two files have is counted once, and file_of(episode) and "
      "number_in_file(episode) say where a row is from. Tables that the question reads are copied aside for it, into "
      "a file without a name in SQLITE_TMPDIR or /var/tmp, pictures are not. A folder is asked by the index that "
      "`stampede index` makes of all catalogues below it.",
      {{"FILE", "the catalogues, or a folder with an index", false, true},
       {"QUESTION", "SQL, or a name", false, false}},
      {{"--format", "NAME", "how to print", Takes::text, "table", {"table", "csv", "json"}, false},
       {"--list", "", "name the ready questions", Takes::flag, "", {}, false},
       {"--views", "", "say what the views and their columns mean", Takes::flag, "", {}, false},
       {"--datasette",
        "",
        "print the same of FILE for `datasette FILE -m metadata.json --setting suggest_facets off`",
        Takes::flag,
        "",
        {},
        false},
       {"--hash",
        "",
        "print the hash of all that is in FILE but host times: equal data, equal hash",
        Takes::flag,
        "",
        {},
        false}},
      {"stampede query demos.db failures_by_reason",
       "stampede query demos.db \"SELECT task, count(*) FROM demos GROUP BY task\" --format csv",
       "stampede query shards \"SELECT task, count(*) FROM segments GROUP BY task\"",
       "stampede query part1.db part2.db \"SELECT file_of(episode), task, count(*) FROM episodes GROUP BY 1, 2\""},
      do_query};
}

}  // namespace stampede::program
