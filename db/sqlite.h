// SQLite as values: a connection and a prepared statement whose mistakes are errors. Inside this room only.
#pragma once

#include <sqlite3.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "db/permissions.h"
#include "engine/base/error.h"
#include "engine/geometry/transform.h"

namespace stampede::sql {

inline constexpr int kBusyTimeoutMs = 10'000;  // how long others are waited for

struct Blob {
  std::string_view bytes;
};

// Values for so many places; those that are left are NULL, and where that is `allowed`, NaN too.
enum class UnknownValues { refused, allowed };
template <typename Value>
struct Wide {
  std::span<const Value> values;
  std::size_t places = 0;
  UnknownValues unknown = UnknownValues::refused;
};

class Database {
 public:
  Database() = default;
  // Opens, no question asked of the file yet; its purpose is to write where the flags let it. Throws CatalogueError.
  Database(const std::string& path, int flags, const std::string& shown_path);
  sqlite3* handle() const { return handle_.get(); }
  const std::string& path() const { return path_; }
  explicit operator bool() const { return handle_ != nullptr; }

  void run(const std::string& statements) const;  // one or more, without results
  std::int64_t number(const std::string& statement) const;
  std::string text(const std::string& statement) const;
  [[noreturn]] void fail(int code) const;  // throws CatalogueError with the cure for this code
  void close();                            // throws nothing

  void attach(const std::string& uri, const std::string& name) const;    // of ours: no name comes from a file
  void show(const std::string& table, const std::string& module) const;  // a temporary table of a module of ours
  void only_read() const;                                                // from now on

 private:
  friend class AsQuestion;
  struct Closer {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  std::unique_ptr<Permissions> permissions_;  // outlive the handle
  std::unique_ptr<sqlite3, Closer> handle_;
  std::string path_;
};

// While it lives, the connection takes a user's statements: they read and do nothing else. `read` receives the names of
// the tables and views that they would read.
class AsQuestion {
 public:
  explicit AsQuestion(const Database& database, std::set<std::string>* read = nullptr)
      : permissions_(*database.permissions_), before_(permissions_) {
    permissions_.purpose = Purpose::question;
    permissions_.read = read;
  }
  ~AsQuestion() { permissions_ = before_; }
  AsQuestion(const AsQuestion&) = delete;
  AsQuestion& operator=(const AsQuestion&) = delete;

 private:
  Permissions& permissions_;
  Permissions before_;
};

// SQLite deletes the file that a journal beside a database names as that of several databases. No journal of ours names
// one: throws CatalogueError where one does.
void check_journal(const std::string& path);

// A name as SQL takes it, whatever is in it.
std::string quoted_name(std::string_view name);

// A text of a file as a message shows it: short, on one line, without what a terminal would obey.
std::string shown(std::string_view text);

// A prepared statement. Texts and blobs handed to start() or run() must live until the statement is reset.
class Statement {
 public:
  Statement() = default;
  Statement(const Database& database, const std::string& text, bool keep = false);

  // Binds one value after the other; a Pose takes seven places.
  template <typename... Values>
  Statement& start(const Values&... values) {
    sqlite3_reset(handle_.get());
    place_ = 0;
    (bind(values), ...);
    return *this;
  }
  template <typename... Values>
  void run(const Values&... values) {
    start(values...);
    while (step()) {
    }
  }
  bool step();  // whether there is a row; resets after the last
  // Reads the row's columns, one after the other.
  template <typename... Values>
  void read(Values&... values) {
    place_ = 0;
    (column(values), ...);
  }
  sqlite3_stmt* handle() const { return handle_.get(); }

 private:
  void bind(std::int64_t value);
  void bind(int value) { bind(static_cast<std::int64_t>(value)); }
  void bind(bool value) { bind(static_cast<std::int64_t>(value)); }
  void bind(std::size_t value) { bind(static_cast<std::int64_t>(value)); }
  void bind(double value);
  void bind(double value, UnknownValues unknown) {
    if (unknown == UnknownValues::allowed && std::isnan(value))
      bind(std::nullopt);
    else
      bind(value);
  }
  void bind(const std::optional<double>& value, UnknownValues) { bind(value); }
  void bind(std::string_view value);
  void bind(const std::string& value) { bind(std::string_view(value)); }
  void bind(const char* value) { bind(std::string_view(value)); }
  void bind(Blob value);
  template <typename Value>
  void bind(const Wide<Value>& wide) {
    for (const Value& value : wide.values) bind(value, wide.unknown);
    for (std::size_t i = wide.values.size(); i < wide.places; ++i) bind(std::nullopt);
  }
  void bind(std::nullopt_t);
  void bind(const Pose& value);
  template <typename Value>
  void bind(const std::optional<Value>& value) {
    if (value)
      bind(*value);
    else
      bind(std::nullopt);
  }
  void column(std::int64_t& value) { value = whole(std::numeric_limits<std::int64_t>::min(), kMostWhole); }
  void column(int& value) {
    value = static_cast<int>(whole(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
  }
  void column(std::size_t& value) { value = static_cast<std::size_t>(whole(0, kMostWhole)); }
  void column(bool& value) { value = whole(0, 1) != 0; }
  void column(double& value);
  void column(std::string& value);
  void column(Pose& value);
  template <typename Value>
  void column(std::optional<Value>& value) {
    value.reset();
    if (sqlite3_column_type(handle_.get(), place_) == SQLITE_NULL) {
      ++place_;
      return;
    }
    column(value.emplace());
  }
  static constexpr std::int64_t kMostWhole = std::numeric_limits<std::int64_t>::max();
  // The next column, which is a whole number from `least` to `most`, or NULL: 0. Throws CatalogueError.
  std::int64_t whole(std::int64_t least, std::int64_t most);
  [[noreturn]] void strange_column(int place) const;
  void checked(int code) const;

  struct Finalizer {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  const Database* database_ = nullptr;
  std::unique_ptr<sqlite3_stmt, Finalizer> handle_;
  int place_ = 0;
};

}  // namespace stampede::sql
