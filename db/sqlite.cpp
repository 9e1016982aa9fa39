#include "db/sqlite.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "db/functions.h"
#include "engine/base/stopping.h"

namespace stampede::sql {
namespace {

std::string cure_of(int code) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return "free some space and run again with the same arguments: finished episodes are kept";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "write to a folder and a file that you may change (--out)";
    case SQLITE_CANTOPEN:
      return "check that the folder exists and that you may write in it";
    case SQLITE_NOTADB:
      return "name a catalogue, or another file to write to";
    case SQLITE_CORRUPT:
      return "the file is damaged: take a copy of it, or generate it again";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program is writing to it: wait until that one has ended";
    case SQLITE_IOERR:
      return "the disk refused to read or write: see that it is healthy and has space, then run again";
    default:
      return "";
  }
}

std::string complaint_of(int code, const std::string& message) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return "the disk is full";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "the catalogue cannot be written: it is read-only";
    case SQLITE_CANTOPEN:
      return "the catalogue cannot be opened";
    case SQLITE_NOTADB:
      return "this file is not a database";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "the catalogue is in use";
    default:
      return message;
  }
}

// Asked by SQLite while a statement runs: one that takes long ends when its thread is to end.
int is_stopped(void*) { return stop_asked() ? 1 : 0; }

// Asked when another program has the file; `times`: before. 0: give up.
int wait_a_little(void*, int times) {
  constexpr int kWaitMs = 20;
  if (stop_asked() || times * kWaitMs >= kBusyTimeoutMs) return 0;
  std::this_thread::sleep_for(std::chrono::milliseconds(kWaitMs));
  return 1;
}

constexpr int kInstructionsPerGlance = 100'000;  // of SQLite's, some milliseconds

}  // namespace

Database::Database(const std::string& path, int flags, const std::string& shown_path) : path_(shown_path) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) fail(code);
  sqlite3_extended_result_codes(handle, 1);
  const bool writes = (flags & SQLITE_OPEN_READWRITE) != 0;
  permissions_ = std::make_unique<Permissions>(Permissions{writes ? Purpose::write : Purpose::read});
  add_functions(handle);
  restrict_to(handle, permissions_.get());
  sqlite3_busy_handler(handle, wait_a_little, nullptr);
  sqlite3_progress_handler(handle, kInstructionsPerGlance, is_stopped, nullptr);
}

void Database::run(const std::string& statements) const {
  const int code = sqlite3_exec(handle(), statements.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

std::int64_t Database::number(const std::string& statement) const {
  Statement query(*this, statement);
  std::int64_t value = 0;
  if (query.start().step()) query.read(value);
  return value;
}

std::string Database::text(const std::string& statement) const {
  Statement query(*this, statement);
  std::string value;
  if (query.start().step()) query.read(value);
  return value;
}

void Database::fail(int code) const {
  if ((code & 0xff) == SQLITE_INTERRUPT || (code & 0xff) == SQLITE_BUSY) heed_stop();
  const std::string message = handle() ? sqlite3_errmsg(handle()) : sqlite3_errstr(code);
  throw CatalogueError(path_, complaint_of(code, shown(message)), cure_of(code));
}

void Database::close() { handle_.reset(); }

namespace {
// True while it lives.
class Allowed {
 public:
  explicit Allowed(bool& permission) : permission_(permission) { permission_ = true; }
  ~Allowed() { permission_ = false; }
  Allowed(const Allowed&) = delete;
  Allowed& operator=(const Allowed&) = delete;

 private:
  bool& permission_;
};
}  // namespace

void Database::attach(const std::string& uri, const std::string& name) const {
  const Allowed allowed(permissions_->may_attach);
  Statement(*this, "ATTACH ?1 AS " + quoted_name(name)).run(uri);
}

void Database::show(const std::string& table, const std::string& module) const {
  const Allowed allowed(permissions_->may_show);
  run("CREATE VIRTUAL TABLE temp." + quoted_name(table) + " USING " + quoted_name(module));
}

void Database::only_read() const { permissions_->purpose = Purpose::read; }

void check_journal(const std::string& path) {
  constexpr std::string_view kNamesAnother("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);  // at the end of such a journal
  std::ifstream journal(path + "-journal", std::ios::binary);
  std::string end(kNamesAnother.size(), '\0');
  journal.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  if (!journal.read(end.data(), static_cast<std::streamsize>(end.size())) || end != kNamesAnother) return;
  throw CatalogueError(path, "the journal beside it (" + path + "-journal) names another file, which would be deleted",
                       "no program of ours makes such a journal: move it away, and see whom the file is from");
}

std::string quoted_name(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 200;
  std::size_t end = std::min(text.size(), kMost);
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  std::string visible;
  for (std::size_t i = 0; i < end; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const unsigned next = i + 1 < end ? static_cast<unsigned char>(text[i + 1]) : 0;
    const bool two = byte == 0xc2 && next >= 0x80 && next < 0xa0;  // the other control characters, in UTF-8
    visible += byte < 0x20 || byte == 0x7f || two ? ' ' : text[i];
    if (two) ++i;
  }
  return end < text.size() ? visible + " …" : visible;
}

Statement::Statement(const Database& database, const std::string& text, bool keep) : database_(&database) {
  sqlite3_stmt* handle = nullptr;
  const int code = sqlite3_prepare_v3(database.handle(), text.c_str(), static_cast<int>(text.size()),
                                      keep ? SQLITE_PREPARE_PERSISTENT : 0, &handle, nullptr);
  handle_.reset(handle);
  checked(code);
}

void Statement::checked(int code) const {
  if (code != SQLITE_OK) database_->fail(code);
}

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) {
    try {
      database_->fail(code);
    } catch (...) {
      sqlite3_reset(handle_.get());
      throw;
    }
  }
  checked(sqlite3_reset(handle_.get()));
  return false;
}

void Statement::bind(std::int64_t value) { checked(sqlite3_bind_int64(handle_.get(), ++place_, value)); }

void Statement::bind(double value) {
  // SQLite would store NULL, and nobody could tell it from a value that is not there.
  if (std::isnan(value))
    throw CatalogueError(database_->path(), "a value of the episode is not a number (NaN)",
                         "the simulation went astray: report the task, variation and seed");
  checked(sqlite3_bind_double(handle_.get(), ++place_, value));
}

void Statement::bind(std::string_view value) {
  // A null pointer would mean NULL.
  checked(sqlite3_bind_text64(handle_.get(), ++place_, value.data() ? value.data() : "", value.size(), SQLITE_STATIC,
                              SQLITE_UTF8));
}

void Statement::bind(Blob value) {
  checked(sqlite3_bind_blob64(handle_.get(), ++place_, value.bytes.data() ? value.bytes.data() : "", value.bytes.size(),
                              SQLITE_STATIC));
}

void Statement::bind(std::nullopt_t) { checked(sqlite3_bind_null(handle_.get(), ++place_)); }

void Statement::bind(const Pose& value) {
  for (const double number : value.position) bind(number);
  for (const double number : value.quaternion) bind(number);
}

// A file may hold anything in any column, whatever its tables declare.
void Statement::strange_column(int place) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), place));
  const char* name = sqlite3_column_name(handle_.get(), place);
  throw CatalogueError(database_->path(),
                       std::string("a value of ") + (name ? name : "a column") + " can be none: '" +
                           shown(text ? text : "").substr(0, 40) + "'",
                       "the file was damaged or changed by hand: take a copy of it, or generate it again");
}

std::int64_t Statement::whole(std::int64_t least, std::int64_t most) {
  const int place = place_++, type = sqlite3_column_type(handle_.get(), place);
  if (type == SQLITE_NULL) return 0;
  const std::int64_t value = sqlite3_column_int64(handle_.get(), place);
  if (type != SQLITE_INTEGER || value < least || value > most) strange_column(place);
  return value;
}

void Statement::column(double& value) {
  const int place = place_++, type = sqlite3_column_type(handle_.get(), place);
  if (type == SQLITE_TEXT || type == SQLITE_BLOB) strange_column(place);
  value = sqlite3_column_double(handle_.get(), place);
}

void Statement::column(std::string& value) {
  const void* data = sqlite3_column_blob(handle_.get(), place_);
  const int size = sqlite3_column_bytes(handle_.get(), place_++);
  value.assign(static_cast<const char*>(data ? data : ""), static_cast<std::size_t>(size));
}

void Statement::column(Pose& value) {
  for (double& number : value.position) column(number);
  for (double& number : value.quaternion) column(number);
}

}  // namespace stampede::sql
