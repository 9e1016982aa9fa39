#include "db/plain_file.h"

#include <algorithm>
#include <system_error>

#include "db/declared.h"
#include "db/embedded_sql.h"
#include "db/read_only.h"
#include "db/sqlite.h"
#include "engine/base/scratch_folder.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

using sql::quoted_name;

void bind_value(sql::Database& database, sqlite3_stmt* statement, int place, const SqlValue& value) {
  int code = SQLITE_OK;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    code = sqlite3_bind_int64(statement, place, *integer);
  } else if (const auto* real = std::get_if<double>(&value)) {
    if (*real != *real)  // SQLite would store NULL
      throw CatalogueError(database.path(), "a value is not a number (NaN)", "make the catalogue again");
    code = sqlite3_bind_double(statement, place, *real);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    code = sqlite3_bind_text64(statement, place, text->data(), text->size(), SQLITE_STATIC, SQLITE_UTF8);
  } else if (const auto* blob = std::get_if<SqlBlob>(&value)) {
    code = sqlite3_bind_blob64(statement, place, blob->bytes.data(), blob->bytes.size(), SQLITE_STATIC);
  } else {
    code = sqlite3_bind_null(statement, place);
  }
  if (code != SQLITE_OK) database.fail(code);
}

}  // namespace

struct PlainFileWriter::Impl {
  explicit Impl(const fs::path& file) : path(file), scratch(file) {}
  fs::path path;
  ScratchFolder scratch;
  sql::Database database;
  sql::Statement insert;
  std::vector<std::string> indexes;
};

PlainFileWriter::PlainFileWriter(const fs::path& path) : impl_(std::make_unique<Impl>(path)) {
  impl_->database = sql::Database(fs::absolute(impl_->scratch.file()).string(),
                                  SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, path.string());
  impl_->database.run("PRAGMA page_size = 4096; PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF; BEGIN");
}

PlainFileWriter::PlainFileWriter(PlainFileWriter&&) noexcept = default;
PlainFileWriter::~PlainFileWriter() = default;

void PlainFileWriter::table(const std::string& name, const std::vector<std::string>& columns) {
  std::string list, places;
  for (const std::string& column : columns) {
    list += (list.empty() ? "" : ", ") + quoted_name(column);
    places += places.empty() ? "?" : ", ?";
    if (column == "episode" || column == "piece")
      impl_->indexes.push_back("CREATE INDEX " + quoted_name(name + "_" + column) + " ON " + quoted_name(name) + " (" +
                               quoted_name(column) + ")");
  }
  impl_->database.run("CREATE TABLE " + quoted_name(name) + " (" + list + ")");
  impl_->insert =
      sql::Statement(impl_->database, "INSERT INTO " + quoted_name(name) + " VALUES (" + places + ")", true);
}

void PlainFileWriter::row(const std::vector<SqlValue>& values) {
  sqlite3_stmt* statement = impl_->insert.handle();
  int place = 0;
  for (const SqlValue& value : values) bind_value(impl_->database, statement, ++place, value);
  while (impl_->insert.step()) {
  }
}

void PlainFileWriter::finish() {
  impl_->insert = {};
  for (const std::string& index : impl_->indexes) impl_->database.run(index);
  impl_->database.run("COMMIT");
  impl_->database.close();
  std::error_code error;
  fs::rename(impl_->scratch.file(), impl_->path, error);
  if (error) throw CatalogueError(impl_->path.string(), "it cannot be written: " + error.message());
}

struct PlainFile::Impl {
  fs::path path;
  sql::Database database;
};

PlainFile::PlainFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PlainFile::PlainFile(PlainFile&&) noexcept = default;
PlainFile::~PlainFile() = default;

PlainFile PlainFile::open(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    throw CatalogueError(path.string(), "there is no such file", "name a folder that `stampede dataset` has made");
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  sql::check_journal(path.string());
  impl->database = sql::Database(path.string(), SQLITE_OPEN_READONLY, path.string());
  check_plain_tables(impl->database);
  return PlainFile(std::move(impl));
}

Rows PlainFile::query(std::string_view select, const std::vector<SqlValue>& parameters) const {
  return read_only_query(impl_->database, select, parameters);
}

std::vector<std::string> PlainFile::tables() const {
  std::vector<std::string> names;
  for (const auto& row : query("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name").rows)
    names.push_back(std::get<std::string>(row[0]));
  return names;
}

bool PlainFile::has(std::string_view table) const {
  const std::vector<std::string> all = tables();
  return std::find(all.begin(), all.end(), table) != all.end();
}

const fs::path& PlainFile::path() const { return impl_->path; }

const std::vector<DatasetTable>& dataset_tables() {
  static const std::vector<DatasetTable> tables = [] {
    std::vector<DatasetTable> list;
    for (const SqlFile& file : embedded_datasets()) {
      const std::string first = file.text.substr(0, file.text.find('\n'));
      list.push_back({file.name, first.substr(first.find_first_not_of("- ")), file.text});
    }
    return list;
  }();
  return tables;
}

const DatasetTable* find_dataset_table(std::string_view name) {
  for (const DatasetTable& table : dataset_tables())
    if (table.name == name) return &table;
  return nullptr;
}

}  // namespace stampede
