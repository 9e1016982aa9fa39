// Several catalogues asked as one: each file stays as it is, and what a question needs of it is copied aside.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "db/catalogue.h"

namespace stampede {

// Episodes are numbered anew, from 1, file by file as they are given; `file_of` and `number_in_file` tell SQL where one
// comes from. An episode that two files have is there once. One file alone is asked as Catalogue does, by its own
// numbers. The tables that a question reads are copied into a database that nobody else sees and that is gone with this
// program, however it ends; pictures are read where they lie. A folder alone is asked by its index (db/lake.h).
// Lifetime: one thread at a time, but for interrupt().
// Throws: CatalogueError for a file that cannot serve, for two with other content under one key or that disagree about
// a variation (it names both), and where there is no room for the copy.
class CatalogueSet {
 public:
  explicit CatalogueSet(const std::vector<std::filesystem::path>& files);
  ~CatalogueSet();
  CatalogueSet(CatalogueSet&&) noexcept;
  CatalogueSet& operator=(CatalogueSet&&) noexcept;

  // As those of Catalogue. Episodes that others add to the files meanwhile are seen, and numbered after all others.
  QueryResult query(std::string_view question, const QueryOptions& options = {}) const;
  void query(std::string_view question, RowReceiver& receiver, const QueryOptions& options = {}) const;
  void interrupt() const;  // from any thread

  struct Place {
    const Catalogue& catalogue;
    std::int64_t episode;  // its number there
  };
  Place place(std::int64_t episode) const;  // throws Error for an unknown one; of a folder, until the next is asked for
  std::int64_t not_indexed() const;         // catalogues below a folder that its index does not know

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
