#include <atomic>
#include <chrono>
#include <ostream>
#include <thread>

#include "db/catalogue.h"
#include "db/reference.h"
#include "db/table_text.h"
#include "scripting/commands/commands.h"

namespace stampede::program {
namespace {

// While it lives, Ctrl-C ends the catalogue's running question.
class StopsQuestion {
 public:
  StopsQuestion(const Catalogue& catalogue, const Console& console)
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
  const Catalogue catalogue = Catalogue::open(arguments.text("FILE"));
  try {
    const StopsQuestion stops(catalogue, console);
    catalogue.query(arguments.text("QUESTION"), writer);
  } catch (const Error&) {
    if (!console.stopped()) throw;
    console.err << "interrupted: the question was not answered to its end\n";
    return kNo;
  }
  writer.finish();
  return kDone;
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
    if (!arguments.has("FILE")) throw UsageError("stampede query --datasette needs FILE", "name a catalogue");
    console.out << datasette_metadata(std::filesystem::path(arguments.text("FILE")).stem().string());
    return kDone;
  }
  if (arguments.flag("--hash")) {
    if (!arguments.has("FILE")) throw UsageError("stampede query --hash needs FILE", "name a catalogue");
    QueryResult hash;
    hash.columns = {"content_hash"};
    hash.rows = {{Catalogue::open(arguments.text("FILE")).content_hash()}};
    return write(hash);
  }
  if (!arguments.has("FILE") || !arguments.has("QUESTION"))
    throw UsageError("stampede query needs FILE and QUESTION", "stampede query --list names the ready questions");
  return answer(arguments, *writer, console);
}

}  // namespace

CommandRow query_command() {
  return {"query",
          "Ask a catalogue in SQL, or by the name of a ready question",
          "The catalogue is opened read-only: a question that would write is refused. The views that SQL may use are "
          "described in db/README.md, and by --views; --list names the ready questions.",
          {{"FILE", "the catalogue", false, false}, {"QUESTION", "SQL, or a name", false, false}},
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
           "stampede query demos.db \"SELECT task, count(*) FROM demos GROUP BY task\" --format csv"},
          do_query};
}

}  // namespace stampede::program
