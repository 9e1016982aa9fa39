// Plain SQLite files beside catalogues: tables without views or rules of ours, for anybody to read. Data sets are such
// files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "db/query.h"

namespace stampede {

// Writes one new file; it has its name once finish() has returned, and until then none. The same calls give the same
// bytes. Throws CatalogueError where it cannot be written, and for NaN. Lifetime: one thread at a time.
class PlainFileWriter {
 public:
  explicit PlainFileWriter(const std::filesystem::path& path);
  ~PlainFileWriter();  // without finish(): nothing is left
  PlainFileWriter(PlainFileWriter&&) noexcept;

  // The rows that follow go into this table. One with a column `episode` or `piece` gets an index on it.
  void table(const std::string& name, const std::vector<std::string>& columns);
  void row(const std::vector<SqlValue>& values);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Reads one. Throws CatalogueError for a file that is no database or not there, and Error for a wrong question.
class PlainFile {
 public:
  static PlainFile open(const std::filesystem::path& path);
  ~PlainFile();
  PlainFile(PlainFile&&) noexcept;

  Rows query(std::string_view select, const std::vector<SqlValue>& parameters = {}) const;  // strictly reading
  bool has(std::string_view table) const;
  std::vector<std::string> tables() const;  // by name
  const std::filesystem::path& path() const;

 private:
  struct Impl;
  explicit PlainFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Of such a file's table and of catalogues' data sets: a SELECT whose rows become a table.
struct DatasetTable {
  std::string name, description, select;  // ?1 episode, ?2 segment, ?3 split
};
const std::vector<DatasetTable>& dataset_tables();              // by name: the files of db/datasets
const DatasetTable* find_dataset_table(std::string_view name);  // nullptr: none

}  // namespace stampede
